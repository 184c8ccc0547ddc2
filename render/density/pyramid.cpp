#include "render/density/pyramid.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/density/loops.h"

namespace voxmelt::render {
namespace {

constexpr int kBrickLevel = 3;  // a brick is one cell of it
static_assert(kBrickSide == 1 << kBrickLevel);

void add(Blend& sum, const Blend& part, float weight) {
  sum.matter += weight * part.matter;
  sum.liquid += weight * part.liquid;
  sum.heat += weight * part.heat;
  sum.glow += weight * part.glow;
}

state::Grid half(const state::Grid& grid) { return {(grid.x + 1) / 2, (grid.y + 1) / 2, (grid.z + 1) / 2}; }

// Equal values are not written, so that empty cells take no memory.
void put(Blend& to, const Blend& value) {
  using Bits = std::array<std::uint64_t, sizeof(Blend) / 8>;
  if (std::bit_cast<Bits>(to) != std::bit_cast<Bits>(value)) to = value;
}

// Cells low .. high of a level become the averages of 2x2x2 cells of the finer one.
void reduce(const PyramidLevel& from, PyramidLevel& to, const CellBox& box) {
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int y = box.low.y; y < box.high.y; ++y)
      for (int x = box.low.x; x < box.high.x; ++x) {
        Blend sum;
        for (int fz = 2 * z; fz < std::min(2 * z + 2, from.grid.z); ++fz)
          for (int fy = 2 * y; fy < std::min(2 * y + 2, from.grid.y); ++fy)
            for (int fx = 2 * x; fx < std::min(2 * x + 2, from.grid.x); ++fx)
              add(sum, from.cells[from.index(fx, fy, fz)], 0.125f);
        put(to.cells[to.index(x, y, z)], sum);
      }
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

Pyramid::Pyramid(const state::Grid& grid) {
  state::Grid side = grid;
  for (PyramidLevel& level : levels_) level = PyramidLevel(side = half(side));
}

void Pyramid::refresh(const state::Grid& grid, const state::Grid& brick, const ChannelValues& filtered,
                      bool obstacles, const std::array<float, 257>& emission) {
  const std::uint16_t* obstacle =
      obstacles && !filtered.obstacle.empty() ? filtered.obstacle.data() : nullptr;
  const auto box = [&](int level) {
    const state::Grid& side = levels_[static_cast<std::size_t>(level - 1)].grid;
    const int cells = kBrickSide >> level;
    const state::Grid low{brick.x * cells, brick.y * cells, brick.z * cells};
    return CellBox{
        low,
        {std::min(low.x + cells, side.x), std::min(low.y + cells, side.y), std::min(low.z + cells, side.z)}};
  };
  const CellBox cells = cells_of(grid, brick), first = box(1);
  for (int z = first.low.z; z < first.high.z; ++z)
    for (int y = first.low.y; y < first.high.y; ++y) {
      std::array<ShownRow, 4> rows;
      int count = 0;
      for (int fz = 2 * z; fz < std::min(2 * z + 2, grid.z); ++fz)
        for (int fy = 2 * y; fy < std::min(2 * y + 2, grid.y); ++fy) {
          const std::size_t i = grid.index(cells.low.x, fy, fz);
          rows[static_cast<std::size_t>(count++)] = {filtered.solid.data() + i, filtered.liquid.data() + i,
                                                     filtered.heat.data() + i,
                                                     obstacle == nullptr ? nullptr : obstacle + i};
        }
      std::array<Blend, 4> blends;
      loops().shrink(rows.data(), count, cells.high.x - cells.low.x, emission.data(), blends.data());
      for (int x = first.low.x; x < first.high.x; ++x)
        put(levels_[0].cells[levels_[0].index(x, y, z)], blends[static_cast<std::size_t>(x - first.low.x)]);
    }
  for (int level = 2; level <= kBrickLevel; ++level)
    reduce(levels_[static_cast<std::size_t>(level - 2)], levels_[static_cast<std::size_t>(level - 1)],
           box(level));
}

void Pyramid::refresh_top() {
  for (std::size_t level = kBrickLevel; level < levels_.size(); ++level)
    reduce(levels_[level - 1], levels_[level], {{0, 0, 0}, levels_[level].grid});
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
