#include "render/density/density_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

#include "render/density/low_pass.h"
#include "render/image/vector.h"

namespace voxmelt::render {
namespace {

static_assert(scene::kMostSmooth == kMaxPasses);
static_assert(kMaxPasses < kBrickSide, "a change must not reach past the neighbouring bricks");
constexpr int kRangeHalo = 2;
constexpr std::size_t kBrickCells = static_cast<std::size_t>(kBrickSide) * kBrickSide * kBrickSide;

// Brick flags widened by one brick in every direction.
std::vector<std::uint8_t> widened(const state::Grid& bricks, const std::vector<std::uint8_t>& flags) {
  std::vector<std::uint8_t> wide(flags.size(), 0);
  for (int z = 0; z < bricks.z; ++z)
    for (int y = 0; y < bricks.y; ++y)
      for (int x = 0; x < bricks.x; ++x) {
        if (!flags[bricks.index(x, y, z)]) continue;
        for (int nz = std::max(z - 1, 0); nz <= std::min(z + 1, bricks.z - 1); ++nz)
          for (int ny = std::max(y - 1, 0); ny <= std::min(y + 1, bricks.y - 1); ++ny)
            for (int nx = std::max(x - 1, 0); nx <= std::min(x + 1, bricks.x - 1); ++nx)
              wide[bricks.index(nx, ny, nz)] = 1;
      }
  return wide;
}

// How much of the liquid's filter a cell gets, 0..256, from the liquid and solid around it. Directly above a
// solid with a film of half a cell the liquid's share is about 0.35, with one of two cells 0.9.
std::uint32_t liquid_weight(std::uint32_t liquid, std::uint32_t solid) {
  if (liquid == 0) return 0;
  const float share = static_cast<float>(liquid) / static_cast<float>(liquid + solid);
  return static_cast<std::uint32_t>(256 * smooth_step(0.4f, 0.8f, share));
}

// Light emitted at 257 temperatures: nothing below glow_cold, the square of the way to glow_hot above.
std::array<float, 257> emission_table(double cold, double hot) {
  std::array<float, 257> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const double temperature = static_cast<double>(i) / 256.0;
    const double way = std::clamp((temperature - cold) / std::max(hot - cold, 1e-6), 0.0, 1.0);
    table[i] = static_cast<float>(way * way);
  }
  return table;
}

}  // namespace

int DensityField::update(const state::Volume& volume, const scene::Look& look,
                         const scene::Terrain& terrain) {
  const int liquid_passes = std::clamp(look.smooth, 0, kMaxPasses);
  const int solid_passes = std::clamp(look.smooth_solid, 0, kMaxPasses);
  CellFields fresh = cell_fields(volume, liquid_passes, terrain);

  // Which bricks differ from the last update: all of them when the field has another shape.
  std::vector<std::uint8_t> changed;
  if (liquid_passes != liquid_passes_ || solid_passes != solid_passes_ || !(fresh.grid == cells_.grid) ||
      fresh.obstacle.size() != cells_.obstacle.size()) {
    bricks_ = brick_grid(fresh.grid);
    liquid_passes_ = liquid_passes;
    solid_passes_ = solid_passes;
    for (auto* field : {&intensity_, &solid_, &liquid_, &heat_}) field->assign(fresh.grid.cells(), 0);
    obstacle_.assign(fresh.obstacle.size(), 0);
    ranges_.assign(bricks_.cells(), BrickRange{});
    changed.assign(bricks_.cells(), 1);
  } else {
    changed = changed_bricks(fresh);
  }
  cells_ = std::move(fresh);

  // The filter carries a change into the neighbouring bricks, and their ranges into the next ones.
  const std::vector<std::uint8_t> dirty = widened(bricks_, changed);
  const std::vector<std::uint8_t> range_dirty = widened(bricks_, dirty);
  int filtered = 0;
  for (int z = 0; z < bricks_.z; ++z)
    for (int y = 0; y < bricks_.y; ++y)
      for (int x = 0; x < bricks_.x; ++x) {
        if (!dirty[bricks_.index(x, y, z)]) continue;
        filter_brick(x, y, z);
        ++filtered;
      }
  for (int z = 0; z < bricks_.z; ++z)
    for (int y = 0; y < bricks_.y; ++y)
      for (int x = 0; x < bricks_.x; ++x)
        if (range_dirty[bricks_.index(x, y, z)]) refresh_range(x, y, z);

  if (filtered > 0 || look.glow_cold != glow_cold_ || look.glow_hot != glow_hot_) {
    glow_cold_ = look.glow_cold;
    glow_hot_ = look.glow_hot;
    const auto emission = emission_table(glow_cold_, glow_hot_);
    pyramid_.build(cells_.grid, solid_, liquid_, heat_, cells_.obstacle, emission);
    if (has_obstacles()) matter_pyramid_.build(cells_.grid, solid_, liquid_, heat_, {}, emission);
  }
  return filtered;
}

std::vector<std::uint8_t> DensityField::changed_bricks(const CellFields& fresh) const {
  std::vector<std::uint8_t> changed(bricks_.cells(), 0);
  const state::Grid& grid = fresh.grid;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int bx = 0; bx < bricks_.x; ++bx) {
        std::uint8_t& flag = changed[bricks_.index(bx, y / kBrickSide, z / kBrickSide)];
        if (flag) continue;
        const std::size_t first = grid.index(bx * kBrickSide, y, z);
        const std::size_t bytes =
            2 * static_cast<std::size_t>(std::min(kBrickSide, grid.x - bx * kBrickSide));
        const auto differs = [&](const std::vector<std::uint16_t>& a, const std::vector<std::uint16_t>& b) {
          return std::memcmp(a.data() + first, b.data() + first, bytes) != 0;
        };
        flag = differs(fresh.intensity, cells_.intensity) || differs(fresh.solid, cells_.solid) ||
               differs(fresh.liquid, cells_.liquid) || differs(fresh.heat, cells_.heat) ||
               (!fresh.obstacle.empty() && differs(fresh.obstacle, cells_.obstacle));
      }
  return changed;
}

void DensityField::filter_brick(int bx, int by, int bz) {
  const state::Grid& grid = cells_.grid;
  const int wide = std::max(liquid_passes_, solid_passes_);  // so the shares reach as far as the intensity
  low_pass_brick(grid, bx, by, bz, wide, cells_.solid, solid_);
  low_pass_brick(grid, bx, by, bz, wide, cells_.liquid, liquid_);
  low_pass_brick(grid, bx, by, bz, wide, cells_.heat, heat_);
  if (has_obstacles()) low_pass_brick(grid, bx, by, bz, wide, cells_.obstacle, obstacle_);

  // Most bricks need one of the two filters only.
  const int x0 = bx * kBrickSide, y0 = by * kBrickSide, z0 = bz * kBrickSide;
  const int x1 = std::min(x0 + kBrickSide, grid.x), y1 = std::min(y0 + kBrickSide, grid.y),
            z1 = std::min(z0 + kBrickSide, grid.z);
  std::array<std::uint32_t, kBrickCells> weights;
  std::array<std::uint16_t, kBrickCells> softer;
  std::uint32_t least = 256, most = 0;
  std::size_t k = 0;
  for (int z = z0; z < z1; ++z)
    for (int y = y0; y < y1; ++y)
      for (std::size_t i = grid.index(x0, y, z); i < grid.index(x0, y, z) + static_cast<std::size_t>(x1 - x0);
           ++i) {
        weights[k] =
            liquid_weight(liquid_[i], std::uint32_t{solid_[i]} + (has_obstacles() ? obstacle_[i] : 0u));
        least = std::min(least, weights[k]);
        most = std::max(most, weights[k++]);
      }
  const bool both = least < 256 && most > 0 && liquid_passes_ != solid_passes_;
  low_pass_brick(grid, bx, by, bz, most > 0 ? liquid_passes_ : solid_passes_, cells_.intensity, intensity_);
  if (!both) return;

  const auto each = [&](const auto& action) {
    std::size_t cell = 0;
    for (int z = z0; z < z1; ++z)
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) action(intensity_[grid.index(x, y, z)], cell++);
  };
  each([&](std::uint16_t value, std::size_t cell) { softer[cell] = value; });
  low_pass_brick(grid, bx, by, bz, solid_passes_, cells_.intensity, intensity_);
  each([&](std::uint16_t& value, std::size_t cell) {
    value =
        static_cast<std::uint16_t>((value * (256 - weights[cell]) + softer[cell] * weights[cell] + 128) >> 8);
  });
}

void DensityField::refresh_range(int bx, int by, int bz) {
  const state::Grid& grid = cells_.grid;
  const auto first = [](int brick) { return std::max(brick * kBrickSide - kRangeHalo, 0); };
  const auto last = [](int brick, int side) { return std::min((brick + 1) * kBrickSide + kRangeHalo, side); };
  std::uint16_t low = 0xffff, high = 0;
  for (int z = first(bz); z < last(bz, grid.z); ++z)
    for (int y = first(by); y < last(by, grid.y); ++y) {
      const std::uint16_t* row = intensity_.data() + grid.index(0, y, z);
      for (int x = first(bx); x < last(bx, grid.x); ++x) {
        low = std::min(low, row[x]);
        high = std::max(high, row[x]);
      }
    }
  ranges_[bricks_.index(bx, by, bz)] = {low, high};
}

}  // namespace voxmelt::render
