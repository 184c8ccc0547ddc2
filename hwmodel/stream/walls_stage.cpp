// Finds the cells that stand beside a wall: one of their four sides is blocked, the border included. Gravity
// needs it, and has no window of its own across columns. The stage exists only without heat; with heat,
// conduction finds them.
#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "hwmodel/stream/make_stages.h"

namespace voxmelt::hwmodel {
namespace {

class Walls final : public Stage {
 public:
  explicit Walls(const Design& design)
      : Stage(StageKind::walls, design, design.shape.plane()),
        line_(design.shape.lanes, static_cast<std::size_t>(design.shape.plane())) {}

  // A cell waits for its east and its north side. Between them, and in lane P - 1 before them, it holds one
  // bit more than a cell.
  int output_bits() const override { return design().cell_bits() + 1; }
  std::vector<BufferCost> buffers() const override {
    return {{"plane memory", shape().plane(), lanes(), design().cell_bits() + 1}};
  }

 protected:
  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    Cell* now = line_.tap(0);
    if (in != nullptr) std::copy(in, in + lanes(), now);
    Cell* south = came().z > 0 ? line_.tap(line_.delay()) : nullptr;
    Cell* west = came().x > 0 ? line_.tap(static_cast<std::size_t>(shape().column())) + lanes() - 1 : nullptr;
    for (int lane = 0; lane < lanes(); ++lane, west = now++) {
      touch(*now, west);
      touch(*now, south);
      if (came().x + lane == shape().grid.x - 1) now->beside_wall = 1;
      if (south != nullptr) ++south;
    }
    if (out != nullptr) std::copy_n(line_.tap(line_.delay()), lanes(), out);
  }

 private:
  static void touch(Cell& cell, Cell* side) {  // null: the border
    if (side == nullptr || side->blocked()) cell.beside_wall = 1;
    if (side != nullptr && cell.blocked()) side->beside_wall = 1;
  }

  TapLine<Cell> line_;
};

}  // namespace

std::unique_ptr<Stage> make_walls(const Design& design) { return std::make_unique<Walls>(design); }

}  // namespace voxmelt::hwmodel
