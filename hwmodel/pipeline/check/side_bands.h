// Side bands are what a channel has to carry beside the cells, for the stages that follow. They are found
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

// Holds what runs show after a phase of excess (docs/automaton.md, section 10): a record per run.
class ShownRuns {
 public:
  ShownRuns(const scalar::Reference& reference, state::Grid grid);

  struct Run {
    int first, last;  // heights of its cells
    std::int32_t head, mobility, exposed, dead, limit;
    bool shut;
  };
  const Run* at(int x, int y, int z) const;  // null: the cell is in no run

 private:
  std::size_t column(int x, int z) const { return static_cast<std::size_t>(z) * grid_.x + x; }

  state::Grid grid_;
  std::vector<std::size_t> begins_;  // begin of each column in `runs_`, and the end of the last one
  std::vector<Run> runs_;
};

// Tells what stands around the cells of a state.
class Surroundings {
 public:
  explicit Surroundings(const state::Volume& volume);

  // Returns the number of axes on which a face neighbour is air. It counts them for matter alone.
  int exposed_axes(state::Slot at) const { return around_[at] & 3; }
  // Returns true if one of the four sides is blocked, or is the border.
  bool beside_wall(state::Slot at) const { return (around_[at] & 4) != 0; }
  // Returns true if one of the six face neighbours is.
  bool touches(state::Slot at) const { return (around_[at] & 8) != 0; }

 private:
  state::Field<std::uint8_t> around_;
};

// Holds the side bands behind one stage. A band that is not given is 0 in every cell.
struct SideBands {
  std::shared_ptr<const state::Field<std::uint8_t>> pattern;  // directions
  std::shared_ptr<const Surroundings> axes, sides;
  bool sides_of_blocked = false;                // do blocked cells have the bit of the sides, too?
  std::shared_ptr<const Surroundings> touched;  // what freezes there
  std::shared_ptr<const state::BitPlane> set;
  std::shared_ptr<const ShownRuns> runs;
  bool shown = false;  // true: all that runs show; false: only which cells are in a run
};

}  // namespace voxmelt::hwmodel
