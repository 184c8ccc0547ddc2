#include "render/density/density_field.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "render/density/loops.h"

namespace voxmelt::render {
namespace {

static_assert(scene::kMostSmooth == kMaxPasses);
constexpr int kRangeHalo = 2;
static_assert(kMaxPasses + kRangeHalo <= kBrickSide, "a change must not reach past the neighbouring bricks");
constexpr std::uint8_t kRange = 1 << kChannels;  // a flag beside those of the channels

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

int DensityField::update(const state::Volume& volume, const scene::Look& look, const scene::Terrain& terrain,
                         int threads) {
  if (!workers_ || workers_->threads() != threads) workers_ = std::make_unique<cpu::Workers>(threads);
  const int liquid_passes = std::clamp(look.smooth, 0, kMaxPasses);
  const int solid_passes = std::clamp(look.smooth_solid, 0, kMaxPasses);
  const bool other = !(volume.grid == grid()) || look.glow != glow_;
  if (other) {  // everything starts again as the field of an empty volume
    cells_ = CellFields(volume.grid);
    filtered_ = ChannelValues(volume.grid.cells());
    ranges_.assign(bricks().cells(), BrickRange{});
    dirty_.assign(bricks().cells(), 0);
    parts_.assign(bricks().cells(), {});
    rows_.assign(static_cast<std::size_t>(bricks().y) * static_cast<std::size_t>(bricks().z), 0);
    filters_.clear();
    pyramid_ = matter_pyramid_ = Pyramid(volume.grid);
    stale_.assign(bricks().cells(), 0);
    stale_all_ = stale_any_ = false;
    glow_ = look.glow;
    seen_ = {};
  }
  const bool other_filter = liquid_passes != liquid_passes_ || solid_passes != solid_passes_;
  liquid_passes_ = liquid_passes;
  solid_passes_ = solid_passes;
  if (look.glow_cold != glow_cold_ || look.glow_hot != glow_hot_) stale_all_ = stale_any_ = true;
  glow_cold_ = look.glow_cold;
  glow_hot_ = look.glow_hot;

  const bool had_obstacles = has_obstacles();
  cells_.update(volume, seen_, {liquid_passes, look.glow}, terrain, *workers_);
  seen_ = volume.changed.now();
  if (has_obstacles() != had_obstacles) {
    filtered_.obstacle = Values<std::uint16_t>(cells_.obstacle.size());
    stale_all_ = stale_any_ = true;
  }
  refreshed_.clear();
  if (cells_.changed().empty() && (!other_filter || other)) return 0;

  find_dirty(other_filter && !other);
  const BrickFilter::Task task{cells_, liquid_passes_, solid_passes_, dirty_, parts_, filtered_};
  const int rows = static_cast<int>(dirty_rows_.size());
  const int parts = threads == 1 ? 1 : std::clamp(rows, 1, 4 * threads);
  while (static_cast<int>(filters_.size()) < parts) filters_.emplace_back(grid());
  workers_->run(parts, [&](int part) {
    for (int i = rows * part / parts; i < rows * (part + 1) / parts; ++i) {
      const int row = dirty_rows_[static_cast<std::size_t>(i)];
      filters_[static_cast<std::size_t>(part)].filter_row(task, row % bricks().y, row / bricks().y);
    }
  });
  workers_->run(rows, [&](int i) {
    const int row = dirty_rows_[static_cast<std::size_t>(i)], y = row % bricks().y, z = row / bricks().y;
    for (int x = 0; x < bricks().x; ++x)
      if ((dirty_[bricks().index(x, y, z)] & kRange) != 0) refresh_range({x, y, z});
  });
  for (std::size_t brick = 0; brick < dirty_.size(); ++brick) {
    const std::uint8_t channels = dirty_[brick] & kAllChannels;
    if (channels != 0) refreshed_.push_back(static_cast<std::uint32_t>(brick));
    stale_[brick] |= channels;
  }
  stale_any_ = true;
  return static_cast<int>(refreshed_.size());
}

// What an update must filter: everything that the filter reaches from what has changed.
void DensityField::find_dirty(bool all) {
  std::fill(dirty_.begin(), dirty_.end(), all ? kAllChannels | kRange : 0);
  std::fill(parts_.begin(), parts_.end(),
            all ? DirtyPart{BrickPart::whole(), BrickPart::whole()} : DirtyPart{});
  std::fill(rows_.begin(), rows_.end(), all ? 1 : 0);
  const auto spread = [&](const state::Grid& brick, const BrickPart& part, int reach, std::uint8_t flags) {
    for_reached(bricks(), brick, part, reach, [&](const state::Grid& near, const BrickPart& of) {
      const std::size_t at = bricks().index(near.x, near.y, near.z);
      dirty_[at] |= flags;
      if ((flags & flag_of(kHeat)) != 0)
        parts_[at].heat.add(of);
      else if (flags != kRange)
        parts_[at].matter.add(of);
      rows_[static_cast<std::size_t>(near.z) * static_cast<std::size_t>(bricks().y) +
            static_cast<std::size_t>(near.y)] = 1;
    });
  };
  const int wide = std::max(liquid_passes_, solid_passes_);
  for (const std::uint32_t index : cells_.changed()) {
    const BrickChange& change = cells_.change(index);
    const auto i = static_cast<int>(index);
    const state::Grid brick{i % bricks().x, i / bricks().x % bricks().y, i / bricks().x / bricks().y};
    if (change.heat.any()) spread(brick, change.heat, wide, flag_of(kHeat));
    if (!change.matter.any()) continue;
    // The intensity is filtered by shares of other channels.
    const auto flags = static_cast<std::uint8_t>((change.channels & ~flag_of(kHeat)) | flag_of(kIntensity));
    spread(brick, change.matter, wide, flags);
    spread(brick, change.matter, wide + kRangeHalo, kRange);
  }
  dirty_rows_.clear();
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (rows_[row] != 0) dirty_rows_.push_back(static_cast<int>(row));
}

void DensityField::refresh_pyramids() const {
  if (!stale_any_) return;
  const std::uint8_t shown = kAllChannels & ~flag_of(kIntensity);
  const auto emission = emission_table(glow_cold_, glow_hot_);
  workers_->run(bricks().y * bricks().z, [&](int row) {
    const int y = row % bricks().y, z = row / bricks().y;
    for (int x = 0; x < bricks().x; ++x) {
      if (!stale_all_ && (stale_[bricks().index(x, y, z)] & shown) == 0) continue;
      pyramid_.refresh(grid(), {x, y, z}, filtered_, true, emission);
      if (has_obstacles()) matter_pyramid_.refresh(grid(), {x, y, z}, filtered_, false, emission);
    }
  });
  pyramid_.refresh_top();
  if (has_obstacles()) matter_pyramid_.refresh_top();
  std::fill(stale_.begin(), stale_.end(), 0);
  stale_any_ = stale_all_ = false;
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
