#include "render/density/pyramid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/density/cell_fields.h"

namespace voxmelt::render {
namespace {

void add(Blend& sum, const Blend& part, float weight) {
  sum.matter += weight * part.matter;
  sum.liquid += weight * part.liquid;
  sum.heat += weight * part.heat;
  sum.glow += weight * part.glow;
}

state::Grid half(const state::Grid& grid) { return {(grid.x + 1) / 2, (grid.y + 1) / 2, (grid.z + 1) / 2}; }

// Averages of 2x2x2 cells; `cell(x, y, z)` reads the finer level.
template <class Cell>
void reduce(const state::Grid& from, PyramidLevel& to, const Cell& cell) {
  to.grid = half(from);
  to.cells.assign(to.slice() * (static_cast<std::size_t>(to.grid.z) + 2), Blend{});
  for (int z = 0; z < from.z; ++z)
    for (int y = 0; y < from.y; ++y)
      for (int x = 0; x < from.x; ++x) add(to.cells[to.index(x / 2, y / 2, z / 2)], cell(x, y, z), 0.125f);
}

Blend sample_level(const PyramidLevel& level, float x, float y, float z, float scale) {
  const state::Grid& grid = level.grid;
  const float fx = x * scale - 0.5f, fy = y * scale - 0.5f, fz = z * scale - 0.5f;
  const float bx = std::floor(fx), by = std::floor(fy), bz = std::floor(fz);
  const int ix = static_cast<int>(bx), iy = static_cast<int>(by), iz = static_cast<int>(bz);
  const float wx = fx - bx, wy = fy - by, wz = fz - bz;
  Blend sum;
  if (ix < -1 || iy < -1 || iz < -1 || ix >= grid.x || iy >= grid.y || iz >= grid.z) return sum;
  const Blend* cell = level.cells.data() + level.index(ix, iy, iz);
  const std::size_t row = level.row(), slice = level.slice();
  add(sum, cell[0], (1 - wx) * (1 - wy) * (1 - wz));
  add(sum, cell[1], wx * (1 - wy) * (1 - wz));
  add(sum, cell[row], (1 - wx) * wy * (1 - wz));
  add(sum, cell[row + 1], wx * wy * (1 - wz));
  add(sum, cell[slice], (1 - wx) * (1 - wy) * wz);
  add(sum, cell[slice + 1], wx * (1 - wy) * wz);
  add(sum, cell[slice + row], (1 - wx) * wy * wz);
  add(sum, cell[slice + row + 1], wx * wy * wz);
  return sum;
}

}  // namespace

void Pyramid::build(const state::Grid& grid, const std::vector<std::uint16_t>& solid,
                    const std::vector<std::uint16_t>& liquid, const std::vector<std::uint16_t>& heat,
                    const std::vector<std::uint16_t>& obstacle, const std::array<float, 257>& emission) {
  constexpr float kUnit = 1.0f / static_cast<float>(kFull);
  reduce(grid, levels_[0], [&](int x, int y, int z) {
    const std::size_t i = grid.index(x, y, z);
    Blend blend;
    const int hard = solid[i] + (obstacle.empty() ? 0 : obstacle[i]);
    if (hard == 0 && liquid[i] == 0) return blend;
    blend.matter = static_cast<float>(std::min(kFull, hard + liquid[i])) * kUnit;
    blend.liquid = static_cast<float>(liquid[i]) * kUnit;
    blend.heat = static_cast<float>(heat[i]) * kUnit;
    if (liquid[i] != 0) blend.glow = blend.liquid * emission[std::min(256u, heat[i] * 256u / liquid[i])];
    return blend;
  });
  for (std::size_t l = 1; l < levels_.size(); ++l)
    reduce(levels_[l - 1].grid, levels_[l],
           [&](int x, int y, int z) { return levels_[l - 1].cells[levels_[l - 1].index(x, y, z)]; });
}

Blend Pyramid::sample(float x, float y, float z, float level) const {
  const float clamped = std::clamp(level, 1.0f, static_cast<float>(kLevels));
  const int lower = std::min(static_cast<int>(clamped), kLevels - 1);
  const float t = clamped - static_cast<float>(lower);
  const auto scale = [](int l) { return 1.0f / static_cast<float>(1 << l); };
  Blend sum;
  add(sum, sample_level(levels_[static_cast<std::size_t>(lower - 1)], x, y, z, scale(lower)), 1 - t);
  if (t > 0) add(sum, sample_level(levels_[static_cast<std::size_t>(lower)], x, y, z, scale(lower + 1)), t);
  return sum;
}

}  // namespace voxmelt::render
