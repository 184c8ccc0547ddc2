#include "measure/two_states.h"

#include <cstdint>

#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/automaton/state/fields.h"
#include "kernel/run/simulation.h"

namespace voxmelt::measure {
namespace {

using state::ChangedBricks;

constexpr int kWordBricks = 64 / state::kBrickSide;

}  // namespace

TwoStates::TwoStates(const Workload& workload, int steps) {
  run::Simulation simulation(workload.parameters, workload.start, run::implementations().widest());
  for (int i = 0; i < workload.lead_steps; ++i) simulation.step();
  before_ = simulation.volume();
  const ChangedBricks::Seen seen = simulation.volume().changed.now();
  for (int i = 0; i < steps; ++i) simulation.step();
  after_ = simulation.volume();

  const ChangedBricks& changed = simulation.volume().changed;
  const state::Grid bricks = state::brick_grid(after_.grid);
  all_ = changed.all_since(seen);
  for (int bz = 0; bz < bricks.z && !all_; ++bz)
    for (int by = 0; by < bricks.y; ++by)
      for (int bx = 0; bx < bricks.x; ++bx)
        for (const auto part : {ChangedBricks::kMatter, ChangedBricks::kHeat})
          if (changed.since(part, seen, bricks.index(bx, by, bz)))
            marks_.push_back({part, static_cast<std::size_t>(bx / kWordBricks), by, bz});
  volume_ = after_;
  volume_.changed.follow(volume_.grid);
}

void TwoStates::take(const state::Volume& from) {
  state::copy_fields(from, volume_);
  volume_.changed.new_version();
  if (all_) volume_.changed.mark_all();
  for (const Mark& mark : marks_)
    volume_.changed.mark(mark.part, std::uint64_t{1} << mark.word, mark.by, mark.bz);
}

}  // namespace voxmelt::measure
