#include "render/density/density_field.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::render {

static_assert(scene::kMostSmooth == kMaxPasses);
static_assert(kMaxPasses <= kBrickSide, "a change must not reach past the neighbouring bricks");

int DensityField::update(const state::Volume& volume, const scene::Look& look, const scene::Terrain& terrain,
                         int threads, const Loops& with) {
  if (!workers_ || workers_->threads() != threads) workers_ = std::make_unique<cpu::Workers>(threads);
  const int liquid_passes = std::clamp(look.smooth, 0, kMaxPasses);
  const int solid_passes = std::clamp(look.smooth_solid, 0, kMaxPasses);
  const std::optional<Tones> tones = tones_of(look);
  const bool other = !(volume.grid == grid()) || look.glow != glow_ || tones != tones_;
  if (other) {  // everything starts again from the field of an empty volume
    cells_ = CellFields(volume.grid);
    filtered_ = ChannelValues(volume.grid.cells());
    dirty_.assign(bricks().cells(), 0);
    parts_.assign(bricks().cells(), {});
    rows_.assign(static_cast<std::size_t>(bricks().y) * bricks().z, 0);
    filters_.clear();
    glow_ = look.glow;
    tones_ = tones;
    seen_ = {};
  }
  const bool other_filter = liquid_passes != liquid_passes_ || solid_passes != solid_passes_;
  liquid_passes_ = liquid_passes;
  solid_passes_ = solid_passes;

  const bool had_obstacles = has_obstacles();
  cells_.update(volume, seen_, {liquid_passes, look.glow, tones}, terrain, *workers_, with);
  seen_ = volume.changed.now();
  if (has_obstacles() != had_obstacles) filtered_.obstacle = Values<std::uint16_t>(cells_.obstacle.size());
  refreshed_.clear();
  if (cells_.changed().empty() && (!other_filter || other)) return 0;

  find_dirty(other_filter && !other);
  const BrickFilter::Task task{cells_, liquid_passes_, solid_passes_, dirty_, parts_, filtered_, with};
  const int rows = static_cast<int>(dirty_rows_.size());
  const int parts = threads == 1 ? 1 : std::clamp(rows, 1, 4 * threads);
  while (static_cast<int>(filters_.size()) < parts) filters_.emplace_back(grid());
  workers_->run(parts, [&](int part) {
    for (int i = rows * part / parts; i < rows * (part + 1) / parts; ++i) {
      const int row = dirty_rows_[i];
      filters_[part].filter_row(task, row % bricks().y, row / bricks().y);
    }
  });
  for (std::size_t brick = 0; brick < dirty_.size(); ++brick)
    if (dirty_[brick] != 0) refreshed_.push_back(static_cast<std::uint32_t>(brick));
  return static_cast<int>(refreshed_.size());
}

// Finds what an update must filter. The filter reaches all of that from a change.
void DensityField::find_dirty(bool all) {
  std::fill(dirty_.begin(), dirty_.end(), all ? kAllChannels : 0);
  std::fill(parts_.begin(), parts_.end(),
            all ? DirtyPart{BrickPart::whole(), BrickPart::whole()} : DirtyPart{});
  std::fill(rows_.begin(), rows_.end(), all ? 1 : 0);
  const auto spread = [&](const state::Grid& brick, const BrickPart& part, int reach, std::uint8_t flags) {
    for_reached(bricks(), brick, part, reach, [&](const state::Grid& near, const BrickPart& brick_part) {
      const std::size_t at = bricks().index(near.x, near.y, near.z);
      dirty_[at] |= flags;
      if ((flags & flag_of(kHeat)) != 0)
        parts_[at].heat.add(brick_part);
      else
        parts_[at].matter.add(brick_part);
      rows_[static_cast<std::size_t>(near.z) * bricks().y + near.y] = 1;
    });
  };
  const int wide = channel_passes(liquid_passes_, solid_passes_);
  for (const std::uint32_t index : cells_.changed()) {
    const BrickChange& change = cells_.change(index);
    const int i = index;
    const state::Grid brick{i % bricks().x, i / bricks().x % bricks().y, i / bricks().x / bricks().y};
    if (change.heat.any()) spread(brick, change.heat, wide, flag_of(kHeat));
    if (!change.matter.any()) continue;
    // The intensity is filtered by the shares of other channels.
    const auto flags = static_cast<std::uint8_t>((change.channels & ~flag_of(kHeat)) | flag_of(kIntensity));
    spread(brick, change.matter, wide, flags);
  }
  dirty_rows_.clear();
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (rows_[row] != 0) dirty_rows_.push_back(static_cast<int>(row));
}

}  // namespace voxmelt::render
