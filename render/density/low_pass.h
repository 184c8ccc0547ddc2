// The low-pass filter is that of the paper's section 5, a separable binomial 1-2-1 along z, y and x,
// repeated.
//
// Cells outside the grid repeat the nearest cell inside. Every axis of a pass rounds once, to nearest. The
// result depends on the cells alone, not on the pieces in which it is computed.
#pragma once

#include <cstdint>
#include <memory>

#include "render/density/brick.h"
#include "render/density/loops.h"
#include "render/density/values.h"

namespace voxmelt::render {

inline constexpr int kMaxPasses = 6;
inline constexpr int kMostBricks = 8;  // bricks side by side, filtered at once

// Filters a few bricks side by side, in memory that stays in a cache. Each thread has one.
class LowPass {
 public:
  explicit LowPass(const state::Grid& grid);

  // Takes the cells of a box, at most kMostBricks bricks along x and one along y and z. It takes as much
  // around them as `passes` ask for. `from` must not change meanwhile.
  void load(const Values<std::uint16_t>& from, const CellBox& box, int passes);
  // Continues to `passes` passes in all. These may not exceed those given to load().
  void advance(int passes, const Loops& with = loops());
  // Returns the result of the passes so far, at cell (x, y, z) of the grid and rightward, within the bricks.
  const std::uint16_t* at(int x, int y, int z) const;

 private:
  void copy(const Values<std::uint16_t>& from);

  state::Grid grid_;
  state::Grid origin_;                 // grid cell of cell 0 here
  int x_ = 0, y_ = 0, z_ = 0;          // sides of the current block
  int done_ = 0;                       // passes made so far
  Block<const std::uint16_t> here_{};  // in the grid's own values or in block_
  std::unique_ptr<std::uint16_t[]> block_;
  std::unique_ptr<std::uint16_t[]> room_;
};

// Filters a whole grid.
Values<std::uint16_t> low_pass(const state::Grid& grid, int passes, const Values<std::uint16_t>& from);

}  // namespace voxmelt::render
