// The run loop has the state, visibility, the phases and the books.
//
// With a device stepper the state lies in the device's memory. volume(), ledger() and drift() then fetch it,
// at most once a step. Visibility fetches the two masks that it needs, or the device follows the rays itself.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/state/mid_run.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/visibility/visibility.h"
#include "kernel/run/implementations.h"

namespace voxmelt::gpu {
struct StateOnDevice;
}

namespace voxmelt::run {

class Simulation {
 public:
  Simulation(rule::Parameters parameters, state::Volume initial, const step::Implementation& implementation,
             const step::Tuning& tuning = {},
             std::unique_ptr<visibility::Provider> provider = nullptr);  // null: the usual one

  // Sets the automaton's number of the next step, before the first one. It is 0 without this call.
  void begin_at(std::uint32_t step) { first_step_ = step; }

  // Goes on with a run that was left between two steps. `initial` was its volume, and its first step has been
  // set by begin_at(). It must be called before the first step.
  void resume(state::MidRun run);
  state::MidRun mid_run() const;  // the same of this run, but without a copy of the irradiance

  // Runs one whole step.
  void step();

  // These run one phase of the present step, so that implementations can be compared phase by phase. With a
  // device stepper run_phase() throws std::logic_error, because a device has no phases.
  void begin_step();
  std::vector<step::Phase> phases() const;  // phases of the step that has begun, in their order
  void run_phase(step::Phase phase);
  void end_step() {
    ++steps_done_;
    untold_ = true;
  }
  int substeps() const { return cadence_.substeps; }  // count of the step that has begun last
  step::Moment moment() const { return {step_number(), substep_, cadence_}; }  // moment of the next phase

  // Replaces heat sources, vents and drains between two steps. Vents and drains take effect at the next step,
  // and heat sources at the next step of visibility (docs/automaton.md, section 5). The bits are as if the
  // scene had them from the start. The caller has checked their ranges. Sources need a scene with heat.
  struct Sources {
    std::vector<rule::HeatSource> heat;
    std::vector<rule::Vent> vents;
    std::vector<rule::Drain> drains;
  };
  void change_sources(Sources sources);

  // Replaces the parameters between two steps. A scene with them could begin from any state of the run
  // (scene::change_key). The caller has checked them. They take effect at the next step, and rays of heat
  // sources at the next step of visibility. A stepper is made anew, which costs about as much as the first
  // step.
  void change_parameters(rule::Parameters parameters);

  // Pours and carves by hand between two steps (docs/automaton.md, section 16), and books it as vents and
  // drains do. They tell if a cell of the grid is in the region. If none is, nothing happens.
  bool pour(const rule::Region& region, rule::Temperature temperature);
  bool carve(const rule::Region& region);

  std::uint32_t steps_done() const { return steps_done_; }
  std::uint32_t step_number() const { return first_step_ + steps_done_; }
  const step::Irradiance* irradiance() const { return fetch_light(), host_light(); }
  std::int64_t irradiance_capped() const { return counts().capped; }  // times that a cell was cut
  const state::Volume& volume() const { return fetch(), tell_changes(), volume_; }
  const state::Ledger& ledger() const { return fetch(), ledger_; }
  // Returns where a device has this state, for who reads it there. It holds until the next step or change.
  // There is none with a host stepper, and none before the device's first step, or after a hand has changed
  // the volume.
  std::optional<gpu::StateOnDevice> state_on_device() const;
  const rule::Parameters& parameters() const { return parameters_; }
  int threads() const { return threads_; }  // in use, if the implementation divides work among them
  std::int64_t loose_cells() const;  // solid cells of pieces that nothing holds, by a pass over all solids
  state::Drift drift() const { return state::drift(ledger(), volume()); }

  // Returns the tiles that the next step works on. A device tells none.
  step::AwakeTiles awake() const { return host_ != nullptr ? host_->awake() : step::AwakeTiles{}; }

  // Returns the volume that the next step begins with, for tests that plant a leak.
  state::Volume& mutable_volume() { return touch(), volume_; }
  state::Ledger& mutable_ledger() { return touch(), ledger_; }

  const state::Seconds& seconds() const { return seconds_; }  // with a device stepper, none of a phase
  visibility::Casts casts() const {                           // counts of the whole run
    return counts().casts;
  }
  bool device_follows_rays() const;  // then the provider has nothing to do
  // Returns the name of the implementation that runs the steps: the spare's if a device has failed. Then it
  // says why.
  const std::string& implementation() const { return name_; }
  const std::string& failure() const { return failure_; }
  const visibility::Provider& provider() const { return *provider_; }

 private:
  void make_irradiance();
  void make_stepper();
  void let_pieces_fall();
  template <class Edit>
  bool edit(const rule::Region& region, const Edit& by_hand);
  bool let_pieces_fall_for_device();
  void fetch_masks();
  void fetch_light() const;
  struct Counts {  // of the whole run
    std::int64_t capped = 0;
    visibility::Casts casts;
  };
  Counts counts() const;
  Counts counts_with(const step::RayCounts& of_device) const;
  void keep_counts(const Counts& counts);
  void know_state(const Counts& counts) const;
  void take_step();
  void use_spare(const std::string& why);
  void leave_device(const step::DeviceError& why);
  template <class Work>
  void on_device(const Work& work) const;
  const step::Irradiance* host_light() const { return irradiance_.empty() ? nullptr : &irradiance_; }
  void find_irradiance();
  void run(step::Phase phase, step::Moment moment);
  step::Cadence count_substeps() const;
  void fetch() const {
    if (behind_) download();
  }
  void download() const;
  void tell_changes() const;
  void touch() {
    fetch();
    uploaded_ = false;
    volume_.changed.forget();
  }

  rule::Parameters parameters_;
  mutable state::Volume volume_;
  std::string name_, failure_;
  decltype(step::Implementation::create) create_;  // makes the stepper
  const step::Implementation* spare_;              // goes on if the device fails, or null
  decltype(step::Implementation::told) told_;      // hears why
  step::Tuning tuning_;
  std::unique_ptr<step::Stepper> stepper_;
  step::HostStepper* host_ = nullptr;      // the stepper, if it is a host stepper
  step::DeviceStepper* device_ = nullptr;  // the stepper, if it is a device stepper
  std::unique_ptr<visibility::Provider> provider_;
  mutable state::Ledger ledger_;
  mutable bool behind_ = false;          // the device has run on, so volume_ and ledger_ are old
  bool masks_are_old_ = false;           // so are its masks
  bool uploaded_ = false;                // the device holds our state
  mutable bool untold_ = false;          // steps have ended, and volume_.changed does not know of them yet
  mutable step::Irradiance irradiance_;  // empty without radiation
  bool device_has_light_ = false;        // the device found the irradiance of the last step of visibility
  mutable bool light_is_old_ = false;    // and ours is older
  std::int64_t irradiance_capped_ = 0;
  int threads_;
  std::uint32_t first_step_ = 0, steps_done_ = 0;
  step::Cadence cadence_;
  int substep_ = 0;  // of the next phase
  state::Seconds seconds_;
  visibility::Casts casts_before_;  // before the run was resumed, and by devices that it has left

  // Where a spare would go on: our state is that of so many steps, and of such counts.
  mutable std::uint32_t known_steps_ = 0;
  mutable Counts known_counts_;
};

}  // namespace voxmelt::run
