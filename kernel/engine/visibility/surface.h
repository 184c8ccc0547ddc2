// Which faces of the solid cells look at a source (docs/automaton.md, section 5), by words of 64 cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/engine/visibility/opaque.h"

namespace voxmelt::visibility {

// The side of a cell on which a source stands: +1, -1, or 0 where neither face across this axis looks at it.
inline int side_of(std::int64_t source, int cell) {
  const std::int64_t delta = source - (rule::kPositionUnit * cell + rule::kPositionUnit / 2);
  return delta > rule::kPositionUnit / 2 ? 1 : delta < -rule::kPositionUnit / 2 ? -1 : 0;
}

class Surface {
 public:
  Surface(const state::Grid& grid, const rule::Position& source) : grid_(grid), source_(source) {
    const std::size_t words = (static_cast<std::size_t>(grid.x) + 63) / 64;
    up_.assign(words, 0);
    down_.assign(words, 0);
    for (int x = 0; x < grid.x; ++x) {
      const int side = side_of(source.x, x);
      const std::uint64_t bit = std::uint64_t{side != 0} << (x & 63);
      (side > 0 ? up_ : down_)[static_cast<std::size_t>(x) >> 6] |= bit;
    }
  }

  // Across x, y and z: the cells of a word whose face looks at the source.
  std::array<std::uint64_t, 3> faces(const Opaque& opaque, std::size_t w, int y, int z) const {
    const std::uint64_t solid = opaque.solid().row(y, z)[w];
    if (solid == 0) return {};
    const auto row = opaque.plane().row(y, z);
    const std::uint64_t above = row[w] >> 1 | (w + 1 < row.size() ? row[w + 1] << 63 : 0);
    const std::uint64_t below = row[w] << 1 | (w > 0 ? row[w - 1] >> 63 : 0);
    const auto across = [&](int side, int there, int size, auto&& at) -> std::uint64_t {
      if (side == 0) return 0;
      return there >= 0 && there < size ? solid & ~at(there) : solid;
    };
    const int on_y = side_of(source_.y, y), on_z = side_of(source_.z, z);
    return {solid & ((up_[w] & ~above) | (down_[w] & ~below)),
            across(on_y, y + on_y, grid_.y, [&](int there) { return opaque.plane().row(there, z)[w]; }),
            across(on_z, z + on_z, grid_.z, [&](int there) { return opaque.plane().row(y, there)[w]; })};
  }

 private:
  state::Grid grid_;
  rule::Position source_;
  std::vector<std::uint64_t> up_, down_;  // the cells along x whose upper, or lower, face may look
};

}  // namespace voxmelt::visibility
