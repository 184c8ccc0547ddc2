// The low-pass filter of the paper's section 5: separable binomial 1-2-1 along z, y and x, repeated.
//
// Cells outside the grid repeat the nearest cell inside; every axis of a pass rounds once, to nearest. What
// is filtered depends on the cells alone, not on the pieces in which it is done.
#pragma once

#include <cstdint>
#include <memory>

#include "render/density/brick.h"
#include "render/density/loops.h"
#include "render/density/values.h"

namespace voxmelt::render {

inline constexpr int kMaxPasses = 6;
inline constexpr int kMostBricks = 8;  // side by side, filtered at once

// Filters a few bricks side by side, in memory that stays in a cache. One for each thread.
class LowPass {
 public:
  explicit LowPass(const state::Grid& grid);

  // Takes the cells of a box, at most kMostBricks bricks along x and one along y and z, and as much around
  // them as `passes` ask. `from` must not change meanwhile.
  void load(const Values<std::uint16_t>& from, const CellBox& box, int passes);
  // Carries on to `passes` passes in all, at most as many as asked for.
  void advance(int passes, const Loops& with = loops());
  // What the passes made so far gave, at cell (x, y, z) of the grid and rightward, within the bricks.
  const std::uint16_t* at(int x, int y, int z) const;

 private:
  void copy(const Values<std::uint16_t>& from);

  state::Grid grid_;
  state::Grid origin_;                 // the cell of the grid that is cell 0 of what is here
  int x_ = 0, y_ = 0, z_ = 0;          // sides of what is here
  int done_ = 0;                       // passes
  Block<const std::uint16_t> here_{};  // in the grid's own values or in block_
  std::unique_ptr<std::uint16_t[]> block_;
  std::unique_ptr<std::uint16_t[]> room_;
};

// Filters a whole grid.
Values<std::uint16_t> low_pass(const state::Grid& grid, int passes, const Values<std::uint16_t>& from);

}  // namespace voxmelt::render
