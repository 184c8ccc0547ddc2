// What a channel has to carry beside the cells: the side bands, for the stages that follow. They are found
// from the reference's state before the phase and from what the reference itself shows, never from the model.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "kernel/automaton/state/field.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::hwmodel {

// What runs show after a phase of excess (docs/automaton.md, section 10): a record per run.
class ShownRuns {
 public:
  ShownRuns(const scalar::Reference& reference, state::Grid grid);

  struct Run {
    int first, last;  // heights of its cells
    std::int32_t head, mobility, exposed, dead, limit;
  };
  const Run* at(int x, int y, int z) const;  // null: in no run

 private:
  std::size_t column(int x, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_.x) + static_cast<std::size_t>(x);
  }

  state::Grid grid_;
  std::vector<std::size_t> begins_;  // of each column in `runs_`, and the end of the last one
  std::vector<Run> runs_;
};

// What stands around the cells of a state.
class Surroundings {
 public:
  explicit Surroundings(const state::Volume& volume);

  // Of matter: the number of axes on which a face neighbour is air.
  int exposed_axes(state::Slot at) const { return around_[at] & 3; }
  // Is one of the four sides blocked, or the border?
  bool beside_wall(state::Slot at) const { return (around_[at] & 4) != 0; }

 private:
  state::Field<std::uint8_t> around_;
};

// Behind one stage. What is not given is 0 in every cell.
struct SideBands {
  std::shared_ptr<const state::Field<std::uint8_t>> pattern;  // directions
  std::shared_ptr<const Surroundings> axes, sides;
  bool sides_of_blocked = false;  // do blocked cells have the bit of the sides, too?
  std::shared_ptr<const ShownRuns> runs;
  bool shown = false;  // all that runs show; else only which cells are in one
};

}  // namespace voxmelt::hwmodel
