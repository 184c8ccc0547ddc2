// The stepper keeps a state in a device's memory and runs whole steps there. The bits and the books are those
// of the reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/gpu/device.h"
#include "kernel/engine/gpu/shape.h"
#include "kernel/engine/gpu/state_on_device.h"

namespace voxmelt::gpu {

inline constexpr std::size_t kMoments = 10;  // of a brick (program/lists.cl)

class Stepper final : public step::DeviceStepper {
 public:
  // The device has a program for these parameters and this grid, or one for any scene.
  // Bricks of cells that provably stay as they are sleep, unless `sleep` is false.
  Stepper(std::shared_ptr<Device> device, const rule::Parameters& parameters, state::Grid grid,
          bool sleep = true);

  void change_sources(const rule::Parameters& parameters) override;
  void tell_irradiance(const state::ChangedRows& changed) override;
  bool follows_rays(const rule::Heat& heat) const override;
  void find_irradiance(std::uint32_t step) override;
  void download_irradiance(step::Irradiance& irradiance) override;
  step::RayCounts count_rays() override;
  void upload(const state::Volume& volume, const state::Ledger& ledger) override;
  void run_step(std::uint32_t step, const step::Irradiance* irradiance) override;
  void download_masks(state::Volume& volume) override;
  void download(state::Volume& volume, state::Ledger& ledger) override;
  void tell_changes(state::ChangedBricks& changed) override;

  // Counts the bricks in which the last step had work, under the paper's law, beside those that hold matter.
  struct Work {
    int with_matter = 0, beside_matter = 0, heat = 0, gravity = 0, spread = 0, giving = 0;
  };
  Work work();

  // From now on every brick is computed that holds matter, and those that would have slept must stay as they
  // are. fault() names the first one that does not.
  void audit_sleep();
  const std::string& fault() const { return fault_; }

  // Returns where the state lies, for who reads it there. It holds until the next step or upload.
  StateOnDevice where() const;

 private:
  using Buffer = std::unique_ptr<Memory>;
  struct Twice {  // a field as it is, and as it becomes
    Buffer now, next;
    void swap() { now.swap(next); }
  };

  Buffer allocate(std::size_t bytes);
  struct Listing {  // when a list was made, and if the next one takes all bricks that hold matter
    std::int32_t since = 0;
    bool all = true;
  };
  void list_bricks();
  void list_awake();
  void list_givers();
  void list_columns(step::Cadence cadence);
  void list_pairs(step::Cadence cadence);
  void list_falls();
  void take_over();
  std::size_t book_bytes() const;
  std::size_t limit_bytes() const;
  std::int32_t next_moment() { return ++moment_; }
  void forget_moments();
  std::vector<std::int32_t> read_moments();
  template <class Visit>
  void for_each_brick(const Visit& visit);
  void fetch_changes();
  void find_fault(const char* phase, std::int64_t brick);
  void audit_heat();
  void audit_gravity();
  void audit_spread();
  void source(std::uint32_t step);
  void heat(std::uint32_t step, bool radiates);
  void melt();
  void gravity(std::uint32_t step);
  void spread(std::uint32_t step);
  void viscous_steps(std::uint32_t step);
  step::Cadence count_substeps();
  void settle(std::uint32_t step, int substep, step::Cadence cadence);
  void relax(int stages);
  void spread_runs(std::uint32_t step, int substep, step::Cadence cadence);
  bool upload_irradiance(std::uint32_t step, const step::Irradiance* irradiance);
  void collect_books();
  template <class T>
  T& in_flight(T value);
  void add_light(const rule::SourceKey& source, rule::SourceKind kind);

  static constexpr int kTerms = 26, kLightCut = 24, kLightRays = 25;  // as in program/cells.cl

  std::shared_ptr<Device> device_;
  rule::Parameters parameters_;
  Shape shape_;
  int groups_;
  std::uint64_t bytes_ = 0;    // taken on the device
  std::uint64_t version_ = 0;  // of the state there
  Buffer constants_, tables_, flags_, transient_, pattern_, irradiance_;
  Twice amount_, energy_, heat_;
  Buffer limits_, standing_;  // counters of limits: of each column, and of each group (program/settle.cl)
  Buffer run_, records_, leveling_, impetus_, change_;
  Twice heads_;
  // Moments fit 32 bits until they begin anew. The first of them are not far from that, so that every longer
  // run comes past it.
  static constexpr std::int32_t kLastMoment = 1 << 30;
  std::int32_t moment_ = kLastMoment - 500;
  bool sleep_;
  Listing awake_, givers_;  // givers: of the viscous law, pairs
  Listing columns_listing_, falls_;
  int substeps_ = 0, stages_ = 0;  // of the sub-step before
  std::int32_t falls_since_ = 0;   // when gravity's list was made
  bool audits_ = false, awake_known_ = false, falls_known_ = false,
       givers_known_ = false;  // known: the list tells who sleeps
  std::string fault_;
  // Bricks that have changed or may have, by the last download: their moments, and the one that was told
  // last.
  std::vector<std::int32_t> fetched_;
  std::int32_t fetched_at_ = 0, told_at_ = 0;
  bool all_changed_ = true;
  std::int32_t falls_from_ = 0;  // a brick that was woken then or later is awake for gravity
  Buffer moments_;               // of each brick (program/lists.cl)
  Buffer full_, near_, giving_, columns_, counts_, other_counts_, most_, books_;
  bool knows_light_ = false;  // the device has the irradiance of the last step of visibility
  std::optional<state::ChangedRows> new_light_;  // what is new in it, if that was told
  Buffer light_places_, light_words_;
  std::size_t light_room_ = 0;  // words
  std::int32_t kinds_;          // of sources, to which the program follows rays
  Buffer cubes_, blocks_;       // what is opaque (program/walk.cl)
  bool own_light_ = false;      // the device found the irradiance of the last step of visibility itself
  step::RayCounts ray_counts_;
  int steps_in_books_ = 0;
  // Holds what is being sent or fetched. A device that is lost may still write there, so it lives as long as
  // we do.
  std::shared_ptr<void> in_flight_;
  state::Ledger ledger_;
};

template <class T>
T& Stepper::in_flight(T value) {
  auto held = std::make_shared<T>(std::move(value));
  in_flight_ = held;
  return *held;
}

}  // namespace voxmelt::gpu
