// Coarser and coarser averages of the matter and the obstacles (without the ground), for soft shadows,
// ambient occlusion and the light that glowing liquid throws: a wide cone reads a coarse level where a ray
// would need many samples.
//
// Level l has cells of 2^l cells of the grid, l = 1 .. kLevels; outside the grid there is nothing.
#pragma once

#include <array>
#include <cstddef>

#include "kernel/automaton/state/grid.h"
#include "render/density/cell_fields.h"
#include "render/density/values.h"

namespace voxmelt::render {

struct Blend {
  float matter = 0;  // filled share, 0..1
  float liquid = 0;  // the liquid's part of it
  float heat = 0;    // liquid * temperature
  float glow = 0;    // liquid * emitted light
  friend bool operator==(const Blend&, const Blend&) = default;
};

// A level is stored with a border of one empty cell on every side, so that sampling needs no case for
// the edge.
struct PyramidLevel {
  PyramidLevel() = default;
  explicit PyramidLevel(const state::Grid& size)
      : grid(size), cells(slice() * (static_cast<std::size_t>(size.z) + 2)) {}

  state::Grid grid;  // without the border
  Values<Blend> cells;

  std::size_t row() const { return static_cast<std::size_t>(grid.x) + 2; }
  std::size_t slice() const { return row() * (static_cast<std::size_t>(grid.y) + 2); }
  // Cells -1 .. side along each axis.
  std::size_t index(int x, int y, int z) const {
    return static_cast<std::size_t>(z + 1) * slice() + static_cast<std::size_t>(y + 1) * row() +
           static_cast<std::size_t>(x + 1);
  }
};

class Pyramid {
 public:
  static constexpr int kLevels = 5;

  Pyramid() = default;
  explicit Pyramid(const state::Grid& grid);  // of nothing

  // Takes over the filtered cells of a brick, as far as a brick is one cell; different bricks may be taken
  // over at once. `emission` gives the light of a temperature 0..65535, for each of 256 equal steps.
  // Obstacles count where there are any and `obstacles` says so.
  void refresh(const state::Grid& grid, const state::Grid& brick, const ChannelValues& filtered,
               bool obstacles, const std::array<float, 257>& emission);
  // Computes the levels above, when all bricks have been taken over.
  void refresh_top();

  // Trilinear in space (position in cells of the grid) and linear between levels, 1 <= level <= kLevels.
  Blend sample(float x, float y, float z, float level) const;

  const PyramidLevel& level(int index) const { return levels_[static_cast<std::size_t>(index - 1)]; }

 private:
  std::array<PyramidLevel, kLevels> levels_;
};

}  // namespace voxmelt::render
