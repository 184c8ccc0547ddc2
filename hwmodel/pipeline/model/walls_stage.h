// The walls stage finds the cells that stand beside a wall: one of their four sides is blocked, the border
// included. Gravity needs it, and has no window of its own across columns. The stage exists only without
// heat. With heat, conduction finds these cells.
#pragma once

#include <algorithm>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class Walls final : public Stage {
 public:
  explicit Walls(const Design& design, Faults faults = {})
      : Stage(StageKind::walls, design, design.shape.plane()),
        faults_(faults),
        line_(design.shape.lanes, design.shape.plane()) {}

  // A cell waits for its east and its north side. Between them, and in lane P - 1 before them, it holds one
  // bit more than a cell.
  Wires side_bands() const override { return {Wire::beside_wall}; }
  std::vector<BufferCost> buffers() const override {
    return {{"plane memory", shape().plane(), lanes(), output_bits()}};
  }

 protected:
  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    if (in != nullptr) look(in);
    if (out == nullptr) return;
    std::copy_n(line_.tap(line_.delay()), lanes(), out);
    for (const int lane : each_lane(lag())) faults_.gave(*this, lane, out[lane]);
  }

 private:
  friend Faults;

  void look(const Cell* in) {
    Cell* now = line_.tap(0);
    std::copy(in, in + lanes(), now);
    Cell* south = came().z > 0 ? line_.tap(line_.delay()) : nullptr;
    Cell* west = came().has_west() ? line_.tap(shape().column()) + lanes() - 1 : nullptr;
    const bool at_north_end = came().z == shape().grid.z - 1;
    for (const int lane : each_lane()) {
      touch(*now, west);
      touch(*now, south);
      if (at_north_end || came().x + lane == shape().grid.x - 1) now->beside_wall = 1;
      if (south != nullptr) ++south;
      west = now++;
    }
  }

  static void touch(Cell& cell, Cell* side) {  // null: the border
    if (side == nullptr || side->blocked()) cell.beside_wall = 1;
    if (side != nullptr && cell.blocked()) side->beside_wall = 1;
  }

  [[no_unique_address]] Faults faults_;
  TapLine<Cell> line_;
};

}  // namespace voxmelt::hwmodel
