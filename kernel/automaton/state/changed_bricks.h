// Readers that keep something computed from a volume learn which bricks of 8x8x8 cells may have changed.
//
// Every brick has the versions at which its matter, its heat and its walls were last marked. A reader keeps
// the version that it has seen, and asks for the bricks that are newer. So any number of readers can follow
// one volume, and none clears what another needs. If nobody tells of changes (a volume made or edited by
// hand, a copy), everything counts as changed.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/grid.h"

namespace voxmelt::state {

inline constexpr int kBrickSide = 8;

// Returns how many bricks a grid needs along each axis. The last ones may reach past the grid.
inline Grid brick_grid(const Grid& cells) {
  const auto bricks = [](int side) { return (side + kBrickSide - 1) / kBrickSide; };
  return {bricks(cells.x), bricks(cells.y), bricks(cells.z)};
}

class ChangedBricks {
 public:
  // Names the volume, and the version up to which a reader has seen it. The default has seen nothing.
  struct Seen {
    std::uint64_t volume = 0, version = 0;
  };

  ChangedBricks() = default;
  // A copy is another volume. Nobody tells what changes in it.
  ChangedBricks(const ChangedBricks& /*other*/) {}
  ChangedBricks& operator=(const ChangedBricks& /*other*/) { return forget(), *this; }
  ChangedBricks(ChangedBricks&& other) noexcept { take(other); }
  ChangedBricks& operator=(ChangedBricks&& other) noexcept { return take(other), *this; }
  ~ChangedBricks() = default;

  // The matter is masks, amounts, energies, and the heat that moves with them. The other part is heats alone,
  // which change nearly everywhere while something melts. Walls are the masks of solid and inert cells.
  enum Part { kMatter, kHeat, kWalls };
  static constexpr std::size_t kParts = 3;

  // These functions are for code that changes the volume. No volume is followed at first.
  void follow(const Grid& cells);  // everything counts as changed; from now on changes are told
  void forget();                   // no longer followed
  bool followed() const { return volume_ != 0; }
  void begin() { open_ = true; }  // until `end`, some changes may not have been told yet
  void end() { open_ = false; }
  void new_version() { ++version_; }  // later marks are newer than earlier ones
  // Marks the bricks at y and z that hold cells of these words of 64 cells along x, one bit each. Matter
  // counts with its walls.
  void mark(Part part, std::uint64_t words, int y, int z);
  void mark_flow(std::uint64_t words, int y, int z) { newer(kMatter, words, y, z); }  // but for walls
  void mark_all() {
    for (const Part part : {kMatter, kWalls}) std::ranges::fill(newest_[part], version_);
  }

  // These functions are for readers.
  Seen now() const { return open_ ? Seen{} : Seen{volume_, version_}; }
  bool all_since(const Seen& seen) const { return open_ || volume_ == 0 || seen.volume != volume_; }
  bool none_since(const Seen& seen) const { return !all_since(seen) && seen.version == version_; }
  // Tells if a part of a brick is newer. It may be called only if `all_since` is false.
  bool since(Part part, const Seen& seen, std::size_t brick) const {
    return newest_[part][brick] > seen.version || (part == kHeat && newest_[kMatter][brick] > seen.version);
  }

 private:
  void newer(Part part, std::uint64_t words, int y, int z);
  void take(ChangedBricks& other) noexcept;

  std::uint64_t volume_ = 0;  // a number that no other volume has; 0: not followed
  std::uint64_t version_ = 0;
  bool open_ = false;
  Grid bricks_;
  std::array<std::vector<std::uint64_t>, kParts> newest_;  // [part][z][y][x]
};

}  // namespace voxmelt::state
