/// @file
/// What has changed between two looks at a state, for those who keep something computed from it.
#pragma once

#include <cstdint>
#include <vector>

namespace voxmelt {

/// Cells along each side of a brick.
inline constexpr int kBrickSide = 8;

/// A brick of 8 x 8 x 8 cells that may have changed: x..x + 7, and so on, as far as the grid reaches.
struct ChangedBrick {
  int x = 0;            ///< its first cell along x
  int y = 0;            ///< its first cell upwards
  int z = 0;            ///< its first cell along z
  bool matter = false;  ///< masks, amounts or energies may have changed, too; otherwise heats alone
  friend bool operator==(const ChangedBrick&, const ChangedBrick&) = default;  ///< the same brick and change
};

/// The bricks that may have changed since a version of the state.
struct Changes {
  std::uint64_t version = 0;         ///< of the present state: to be asked for the next time
  bool everything = false;           ///< nothing is known of that version: all bricks are listed
  std::vector<ChangedBrick> bricks;  ///< x fastest, then y, then z
};

}  // namespace voxmelt
