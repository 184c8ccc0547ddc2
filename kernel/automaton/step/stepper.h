// Every implementation of the automaton is a stepper. There are two kinds. A host stepper computes in the run
// loop's memory, one phase at a time. So any two can be compared after each phase. A device stepper (a GPU,
// an FPGA, another process) runs whole steps in memory of its own, and gives the state back when asked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/awake_tiles.h"
#include "kernel/automaton/step/phase.h"

namespace voxmelt::step {

using Irradiance = state::Field<std::uint16_t>;  // UQ12.4 temperature units per step

class Stepper {
 public:
  virtual ~Stepper() = default;

  // Marks the bricks in which its steps may have changed the volume since the last call. The run loop calls
  // it when somebody wants to see the volume. It asks a host stepper after a phase. It asks a device after a
  // download, for all steps up to it. A stepper that does not know better marks all bricks. Then a follower
  // of the volume, such as a picture, scans all of it.
  virtual void tell_changes(state::ChangedBricks& changed) { changed.mark_all(); }

  // Replaces point sources, vents and drains by those of `parameters`, from the next step on. All else in it
  // is as it was when the stepper was created, but `heat.radiation` may become true.
  virtual void change_sources(const rule::Parameters& parameters) = 0;

  // Tells which irradiance is new in the step that begins. A step of visibility may go without this call.
  // Then all of it may be new.
  virtual void tell_irradiance(const state::ChangedRows& /*changed*/) {}
};

class HostStepper : public Stepper {
 public:
  // Lets loose pieces fall, as the first thing in a step (docs/automaton.md, section 15). It tells if a cell
  // has moved. The run loop calls it only in scenes with such pieces.
  virtual bool let_pieces_fall(std::uint32_t /*step*/, state::Volume& /*volume*/) { return false; }

  // Tells which rows a hand has changed between two steps. Tiles that sleep there, and beside it, wake up.
  virtual void tell_matter(const state::ChangedRows& /*changed*/, state::Volume& /*volume*/) {}

  // Runs one phase on `volume` and books it in `ledger`. Between two steps, nothing else changes the volume,
  // unless tell_matter() says so.
  // `irradiance` is null when the scene has no radiation. After a phase with `moment.unseen` the volume and
  // the books may be those before it, until the next phase has run.
  virtual void run(Phase phase, Moment moment, const Irradiance* irradiance, state::Volume& volume,
                   state::Ledger& ledger) = 0;

  // Returns the tiles that the next step works on. Vents, drains and new irradiance may wake more of them.
  virtual AwakeTiles awake() const { return {}; }
};

// Says what a device or its driver refuses, in words for users.
class DeviceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Says that a device does not answer. Threads of its driver may still work, so a program must not clean up
// what they use.
class DeviceLost : public DeviceError {
 public:
  explicit DeviceLost(const std::string& what) : DeviceError(what) { happened = true; }
  static inline bool happened = false;  // in this program
};

// Counts of a device that follows rays itself, since it was made.
struct RayCounts {
  std::int64_t capped = 0;  // times that a cell was cut at the largest irradiance
  std::int64_t rays = 0;    // that were cast
};

// Every function may throw DeviceError. Then the host's volume is the one of the last download.
class DeviceStepper : public Stepper {
 public:
  // Copies a state and its books to the device, in place of its old contents.
  virtual void upload(const state::Volume& volume, const state::Ledger& ledger) = 0;

  // Tells if the device can follow the rays of these sources itself, in the state that it holds
  // (docs/automaton.md, section 5). Only then are the three functions below called.
  virtual bool follows_rays(const rule::Heat& /*heat*/) const { return false; }
  // Computes the irradiance of the step that begins, and keeps it in place of what it had.
  virtual void find_irradiance(std::uint32_t /*step*/) {}
  virtual void download_irradiance(Irradiance& /*irradiance*/) {}
  virtual RayCounts count_rays() { return {}; }

  // Runs all phases of step number `step`. If the scene does not say how many sub-steps it has, the device
  // counts them in its own state (docs/automaton.md, section 10). `irradiance` lies in the host's memory. It
  // is null when the scene has no radiation, or when the device found the irradiance itself. Its values
  // change only at steps divisible by heat.visibility_every.
  virtual void run_step(std::uint32_t step, const Irradiance* irradiance) = 0;

  // Copies `solid` and `inert` into the volume, which has the grid's size. Visibility needs no more: it reads
  // amounts of solid cells, too, but those never change.
  virtual void download_masks(state::Volume& volume) = 0;

  // Copies the whole state and the books, with every term booked until now. It writes the fields of the
  // volume (state::copy_fields). The record of its changes stays, and the next tell_changes adds to it.
  virtual void download(state::Volume& volume, state::Ledger& ledger) = 0;
};

// Sets how an implementation works. No result depends on it.
struct Tuning {
  int threads = 1;
  bool sleep = true;   // skip what provably stays as it is
  int tile_shift = 3;  // rows of a tile of work: 2^tile_shift, 0..12
  // A grid must have this many cells for gravity to run a slice ahead of spread (paper law).
  std::size_t ahead_from = std::size_t{1} << 20;
};

struct Implementation {
  std::string name;
  std::string description;
  std::function<std::unique_ptr<Stepper>(const rule::Parameters& parameters, state::Grid grid,
                                         const Tuning& tuning)>
      create;
  bool supported = true;     // this processor can run it
  bool whole_steps = false;  // a device: it runs no single phase
  bool is_card = false;      // a device that is a graphics card, and no processor
  // If a device fails, this one goes on from the last state that was fetched, and `told` hears why. Without
  // it the run ends.
  const Implementation* spare = nullptr;
  std::function<void(const DeviceError&)> told = {};
};

// Every folder of kernel/engine/ with implementations has an add_implementations(registry). kernel/run/ calls
// them, the reference first.
class Registry {
 public:
  void add(Implementation implementation) { implementations_.push_back(std::move(implementation)); }
  const std::vector<Implementation>& all() const { return implementations_; }

  // Returns null for an unknown name. Only kernel/run/trial/fastest.h knows what users call `auto`.
  const Implementation* find(std::string_view name) const {
    for (const Implementation& candidate : implementations_)
      if (candidate.name == name) return &candidate;
    return nullptr;
  }

  // Returns the last one that this processor supports. It makes no trial, so it is the same every time, for
  // tests.
  const Implementation& widest() const {
    const Implementation* found = &implementations_.front();
    for (const Implementation& candidate : implementations_)
      if (candidate.supported) found = &candidate;
    return *found;
  }

 private:
  std::vector<Implementation> implementations_;
};

}  // namespace voxmelt::step
