#include "render/density/density_field.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "render/density/brick_filter.h"
#include "render/density/loops.h"

namespace voxmelt::render {
namespace {

static_assert(scene::kMostSmooth == kMaxPasses);
constexpr int kRangeHalo = 2;
static_assert(kMaxPasses + kRangeHalo <= kBrickSide, "a change must not reach past the neighbouring bricks");

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

// The intensity is filtered by shares of other channels.
BrickFlags with_intensity(BrickFlags flags) {
  const std::uint8_t shares = flag_of(kSolid) | flag_of(kLiquid) | flag_of(kObstacle);
  for (std::uint8_t& flag : flags)
    if ((flag & shares) != 0) flag |= flag_of(kIntensity);
  return flags;
}

}  // namespace

int DensityField::update(const state::Volume& volume, const scene::Look& look, const scene::Terrain& terrain,
                         int threads) {
  if (!workers_ || workers_->threads() != threads) workers_ = std::make_unique<cpu::Workers>(threads);
  const int liquid_passes = std::clamp(look.smooth, 0, kMaxPasses);
  const int solid_passes = std::clamp(look.smooth_solid, 0, kMaxPasses);
  const bool other_grid = !(volume.grid == grid());
  if (other_grid) {  // everything starts again as the field of an empty volume
    cells_ = CellFields(volume.grid);
    filtered_ = ChannelValues(volume.grid.cells());
    ranges_.assign(bricks().cells(), BrickRange{});
    pyramid_ = matter_pyramid_ = Pyramid(volume.grid);
  }
  const bool other_filter = liquid_passes != liquid_passes_ || solid_passes != solid_passes_;
  liquid_passes_ = liquid_passes;
  solid_passes_ = solid_passes;

  const bool had_obstacles = has_obstacles();
  BrickFlags changed = cells_.update(volume, liquid_passes, terrain, *workers_);
  if (has_obstacles() != !filtered_.obstacle.empty())
    filtered_.obstacle = Values<std::uint16_t>(cells_.obstacle.size());
  if (other_filter && !other_grid) std::fill(changed.begin(), changed.end(), kAllChannels);

  // The filter carries a change into the neighbouring bricks, their ranges no farther.
  const BrickFlags dirty = widened(bricks(), with_intensity(std::move(changed)));
  workers_->run(bricks().y * bricks().z, [&](int row) {
    BrickFilter(cells_, liquid_passes_, solid_passes_, filtered_)
        .filter_row(row % bricks().y, row / bricks().y, dirty);
  });
  workers_->run(bricks().y * bricks().z, [&](int row) {
    const int y = row % bricks().y, z = row / bricks().y;
    for (int x = 0; x < bricks().x; ++x)
      if ((dirty[bricks().index(x, y, z)] & flag_of(kIntensity)) != 0) refresh_range({x, y, z});
  });

  const bool other_glow = look.glow_cold != glow_cold_ || look.glow_hot != glow_hot_;
  glow_cold_ = look.glow_cold;
  glow_hot_ = look.glow_hot;
  refresh_pyramids(dirty, !other_grid && (other_glow || has_obstacles() != had_obstacles));
  return static_cast<int>(
      std::count_if(dirty.begin(), dirty.end(), [](std::uint8_t flag) { return flag != 0; }));
}

void DensityField::refresh_pyramids(const BrickFlags& changed, bool all) {
  const std::uint8_t shown = kAllChannels & ~flag_of(kIntensity);
  const auto emission = emission_table(glow_cold_, glow_hot_);
  workers_->run(bricks().y * bricks().z, [&](int row) {
    const int y = row % bricks().y, z = row / bricks().y;
    for (int x = 0; x < bricks().x; ++x) {
      if (!all && (changed[bricks().index(x, y, z)] & shown) == 0) continue;
      pyramid_.refresh(grid(), {x, y, z}, filtered_, true, emission);
      if (has_obstacles()) matter_pyramid_.refresh(grid(), {x, y, z}, filtered_, false, emission);
    }
  });
  pyramid_.refresh_top();
  if (has_obstacles()) matter_pyramid_.refresh_top();
}

void DensityField::refresh_range(const state::Grid& brick) {
  const auto first = [](int b) { return std::max(b * kBrickSide - kRangeHalo, 0); };
  const auto end = [](int b, int side) { return std::min((b + 1) * kBrickSide + kRangeHalo, side); };
  const state::Grid low{first(brick.x), first(brick.y), first(brick.z)};
  BrickRange& range = ranges_[bricks().index(brick.x, brick.y, brick.z)];
  loops().range({filtered_.intensity.data() + grid().index(low.x, low.y, low.z), grid().index(0, 1, 0),
                 grid().index(0, 0, 1)},
                end(brick.x, grid().x) - low.x, end(brick.y, grid().y) - low.y,
                end(brick.z, grid().z) - low.z, &range.low, &range.high);
}

}  // namespace voxmelt::render
