#include "render/density/cell_fields.h"

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "render/density/brick_writer.h"

namespace voxmelt::render {

CellFields::CellFields(const state::Grid& size)
    : ChannelValues(size.cells()),
      grid(size),
      bricks(brick_grid(size)),
      columns_(size),
      inert_(size),
      changes_(bricks.cells()) {
  for (auto& of_channel : uniform_) of_channel.assign(bricks.cells(), 0);
}

bool CellFields::same_terrain(const scene::Terrain& terrain) const {
  if (!fits(terrain, grid)) return terrain_.empty();
  return terrain_.size() == terrain.height.size() &&
         std::memcmp(terrain_.data(), terrain.height.data(), terrain_.size() * sizeof(float)) == 0;
}

void CellFields::update(const state::Volume& volume, const state::ChangedBricks::Seen& seen,
                        const Wanted& wanted, const scene::Terrain& terrain, cpu::Workers& workers,
                        const Loops& with) {
  for (const std::uint32_t brick : changed_) changes_[brick] = {};
  changed_.clear();
  Columns::News news;
  news.everything = !same_terrain(terrain) || wanted.smooth != wanted_.smooth;
  const bool other_heat = wanted.heat != wanted_.heat || wanted.tones != wanted_.tones;
  if (!news.everything && !other_heat && volume.changed.none_since(seen)) return;

  const bool all = other_heat || news.everything || volume.changed.all_since(seen);
  const auto part = wanted.heat ? state::ChangedBricks::kHeat : state::ChangedBricks::kMatter;
  const auto marked = [&](std::size_t brick) { return all || volume.changed.since(part, seen, brick); };
  if (news.everything) terrain_ = fits(terrain, grid) ? terrain.height : std::vector<float>{};
  wanted_ = wanted;
  news.look.assign(static_cast<std::size_t>(bricks.x) * bricks.z, 0);
  workers.run(bricks.z, [&](int bz) { take_matter(volume, bz, marked, news, with); });

  const std::vector<Extent>& another = columns_.update(volume, wanted.smooth, terrain, news, workers, with);
  const bool obstacles = columns_.has_obstacles();
  if (obstacles && obstacle.empty()) obstacle = Values<std::uint16_t>(grid.cells());

  std::vector<std::vector<std::uint32_t>> changed(bricks.z);
  workers.run(bricks.z, [&](int bz) { write_intensities(volume, bz, news, another, with, changed[bz]); });
  for (const auto& list : changed) changed_.insert(changed_.end(), list.begin(), list.end());
  if (!obstacles && !obstacle.empty()) {
    obstacle = {};
    std::fill(uniform_[kObstacle].begin(), uniform_[kObstacle].end(), 0);
  }
}

template <class Marked>
void CellFields::take_matter(const state::Volume& volume, int bz, const Marked& marked, Columns::News& news,
                             const Loops& with) {
  BrickWriter writer(volume, *this, with);
  std::size_t brick = bricks.index(0, 0, bz);
  for (int by = 0; by < bricks.y; ++by) {
    int word = -1;  // word whose inert cells are known
    for (int bx = 0; bx < bricks.x; ++bx, ++brick) {
      if (!marked(brick)) continue;
      if (word != bx / 8) {
        word = bx / 8;
        const std::uint64_t inert = writer.take_inert({bx, by, bz});
        for (int i = 0; inert != 0 && i < 8; ++i)
          if ((inert >> 8 * i & 0xff) != 0) news.look[columns_.brick_at(8 * word + i, bz)] = Columns::kInert;
      }
      writer.write_matter({bx, by, bz});
      std::uint8_t& look = news.look[columns_.brick_at(bx, bz)];
      if (look == Columns::kNothing && by * kBrickSide < columns_.read_to(columns_.brick_at(bx, bz)) &&
          (changes_[brick].matter.any() || !columns_.same_offsets(volume, {bx, by, bz})))
        look = Columns::kMatter;
    }
  }
}

void CellFields::write_intensities(const state::Volume& volume, int bz, const Columns::News& news,
                                   const std::vector<Extent>& another, const Loops& with,
                                   std::vector<std::uint32_t>& changed) {
  BrickWriter writer(volume, *this, with);
  std::size_t brick = bricks.index(0, 0, bz);
  const std::size_t row = bricks.x;
  for (int by = 0; by < bricks.y; ++by)
    for (int bx = 0; bx < bricks.x; ++bx, ++brick) {
      const std::size_t column = columns_.brick_at(bx, bz);
      const int low = by * kBrickSide, high = low + kBrickSide;
      // Matter that moves up or down comes from a cell below or above.
      const Extent& planned = columns_.planned(column);
      const bool moved = planned.low < high && planned.high > low;
      const auto beside = [&](std::size_t other, std::uint8_t plane) {
        constexpr std::uint8_t kMatter = 1 << kSolid | 1 << kLiquid;
        return (changes_[other].channels & kMatter) != 0 && (changes_[other].matter.y & plane) != 0;
      };
      if (changes_[brick].matter.any() || news.everything || news.look[column] == Columns::kInert ||
          (another[column].low < high && another[column].high > low) ||
          (moved && by > 0 && beside(brick - row, 0x80)) ||
          (moved && by + 1 < bricks.y && beside(brick + row, 1)))
        writer.write_intensity({bx, by, bz});
      if (changes_[brick].channels != 0) changed.push_back(static_cast<std::uint32_t>(brick));
    }
}

CellFields cell_fields(const state::Volume& volume, int smooth, const scene::Terrain& terrain) {
  CellFields fields(volume.grid);
  cpu::Workers alone(1);
  fields.update(volume, {}, {smooth, true, {}}, terrain, alone);
  return fields;
}

}  // namespace voxmelt::render
