// The walls have one bit per cell, set if it is solid, inert or beyond the grid. Kernels read this plane to
// know which cells are blocked. It is one word and one row wider than the grid at every side, where
// everything is blocked. A scene keeps a second plane if solids melt and the paper's law reads the sides of a
// falling cell. It has the sides before melt.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/automaton/state/pages.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::parallel {

class Walls {
 public:
  Walls() = default;
  explicit Walls(const simd::View& view);

  // Computes row y of slice z anew, after solids there have melted. It returns the words that are others now.
  simd::TileRow refresh(const simd::View& view, int y, int z) {
    std::uint64_t* walls = row(view, y, z);
    const std::size_t masks = view.word(0, y, z);
    simd::TileRow changed = 0;
    for (int w = 0; w < view.words; ++w) {
      const std::size_t at = w;
      const std::uint64_t beyond = w + 1 == view.words ? ~view.last_word : 0;
      const std::uint64_t now = view.solid[masks + at] | view.inert[masks + at] | beyond;
      if (walls[w] != now) changed |= simd::TileRow{1} << w;
      walls[w] = now;
    }
    return changed;
  }
  const std::uint64_t* origin(const simd::View& view) const {
    return const_cast<Walls*>(this)->row(view, 0, 0);
  }

 private:
  std::uint64_t* row(const simd::View& view, int y, int z) {
    const std::ptrdiff_t rows = static_cast<std::ptrdiff_t>(z + 1) * (view.ny + 2) + y + 1;
    return reinterpret_cast<std::uint64_t*>(pages_.data()) + rows * (view.words + 2) + 1;
  }

  state::Pages pages_;
};

}  // namespace voxmelt::parallel
