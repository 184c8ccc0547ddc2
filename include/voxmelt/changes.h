/// @file
/// This header tells what has changed between two looks at a state. It serves programs that keep something
/// computed from the state.
#pragma once

#include <cstdint>
#include <vector>

namespace voxmelt {

/// Counts the cells along each side of a brick.
inline constexpr int kBrickSide = 8;

/// Names a brick of 8 x 8 x 8 cells that may have changed. It covers x..x + 7 along x, and so on, as far as
/// the grid reaches.
struct ChangedBrick {
  int x = 0;            ///< first cell along x
  int y = 0;            ///< first cell upwards
  int z = 0;            ///< first cell along z
  bool matter = false;  ///< masks, amounts or energies may have changed, too; otherwise heats alone
  friend bool operator==(const ChangedBrick&, const ChangedBrick&) = default;  ///< the same brick and change
};

/// Lists the bricks that may have changed since a version of the state.
struct Changes {
  std::uint64_t version = 0;         ///< version of the present state; ask with it the next time
  bool everything = false;           ///< that version is unknown, so all bricks are listed
  std::vector<ChangedBrick> bricks;  ///< in the order x fastest, then y, then z
};

}  // namespace voxmelt
