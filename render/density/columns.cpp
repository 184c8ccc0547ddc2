#include "render/density/columns.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "kernel/automaton/rule/fixed_point.h"
#include "render/density/levels.h"

namespace voxmelt::render {
namespace {

using rule::kOne;

constexpr std::int32_t kFilm = kOne * 15 / 100;  // a film of this amount counts as fully wet
constexpr int kLevelPasses = 4;                  // passes along the surface of puddles for one in space
constexpr int kMostLevelPasses = 12;             // ... more would flatten domes

class Finder {
 public:
  Finder(const state::Volume& volume, const scene::Terrain* terrain, Columns& columns, Levels& levels)
      : volume_(volume), terrain_(terrain), columns_(columns), levels_(levels) {}

  // All columns of a slice; tells whether obstacles stand in it.
  bool find(int z) {
    for (int x = 0; x < volume_.grid.x; ++x) columns_.bed[columns_.at(x, z)] = volume_.grid.y;
    find_first_free(z);
    find_last_inert(z);
    bool obstacles = false;
    for (int x = 0; x < volume_.grid.x; ++x) {
      const std::size_t c = columns_.at(x, z);
      if (terrain_ != nullptr)
        columns_.bed[c] = std::min<std::int32_t>(
            columns_.bed[c],
            std::max(static_cast<std::int32_t>(std::lround(terrain_->height[c])), std::int32_t{0}));
      obstacles |= columns_.top[c] > columns_.bed[c];
      columns_.top[c] = std::max(columns_.top[c], columns_.bed[c]);
      if (columns_.bed[c] > 0) find_ground(x, z);
      find_level(x, z);
    }
    return obstacles;
  }

 private:
  // Calls visit(x, y) for the first cell of each column, from y = `from` by `step`, whose bit is `wanted`.
  template <class Visit>
  void first_inert(int z, bool wanted, int from, int step, const Visit& visit) const {
    for (int first = 0; first < volume_.grid.x; first += 64) {
      const int columns = std::min(64, volume_.grid.x - first);
      std::uint64_t left = ~std::uint64_t{0} >> (64 - columns);
      for (int y = from; y >= 0 && y < volume_.grid.y && left != 0; y += step) {
        const std::uint64_t word = volume_.inert.row(y, z)[static_cast<std::size_t>(first) / 64];
        std::uint64_t found = left & (wanted ? word : ~word);
        left &= ~found;
        for (; found != 0; found &= found - 1) visit(first + std::countr_zero(found), y);
      }
    }
  }
  void find_first_free(int z) {
    first_inert(z, false, 0, 1, [&](int x, int y) { columns_.bed[columns_.at(x, z)] = y; });
  }
  void find_last_inert(int z) {
    first_inert(z, true, volume_.grid.y - 1, -1,
                [&](int x, int y) { columns_.top[columns_.at(x, z)] = y + 1; });
  }

  void find_ground(int x, int z) {
    const std::size_t c = columns_.at(x, z);
    const int bed = columns_.bed[c];
    columns_.offset[c] = std::clamp<std::int32_t>(volume_.amount[volume_.at(x, bed - 1, z)] - rule::kBedHalf,
                                                  -kOne / 2, kOne / 2);
    columns_.ground[c] =
        static_cast<float>(bed) + static_cast<float>(columns_.offset[c]) / static_cast<float>(kOne);
    columns_.wet[c] = std::min(matter_amount(volume_, x, bed, z), kFilm) * kOne / kFilm;
    columns_.wetness[c] = static_cast<float>(columns_.wet[c]) / static_cast<float>(kOne);
    if (bed < volume_.grid.y && volume_.inert.test(x, bed, z)) columns_.wet[c] = kOne;
  }

  // The level of the liquid that rests on ground or obstacle under open air.
  void find_level(int x, int z) {
    if (levels_.level.empty()) return;
    const std::size_t c = columns_.at(x, z);
    const int floor = puddle_floor(volume_, columns_, x, z);
    if (floor == 0) return;
    std::int32_t depth = 0;
    int y = floor;
    for (; y < volume_.grid.y && volume_.liquid.test(x, y, z); ++y) depth += matter_amount(volume_, x, y, z);
    if (depth == 0 || y == volume_.grid.y || volume_.inert.test(x, y, z) ||
        matter_amount(volume_, x, y, z) != 0)
      return;
    levels_.depth[c] = depth;
    levels_.level[c] = floor * kOne + (floor == columns_.bed[c] ? columns_.offset[c] : 0) + depth;
  }

  const state::Volume& volume_;
  const scene::Terrain* terrain_;  // null where there is none
  Columns& columns_;
  Levels& levels_;
};

// Distances of largest |dx|, |dz|: a column that is not wet is one farther than the nearest of the
// eight around.
void find_distances(Columns& columns) {
  for (std::size_t c = 0; c < columns.wet.size(); ++c)
    columns.distance[c] = columns.wet[c] > 0 ? 0 : kGroundReach + 1;
  std::vector<std::uint8_t> along(columns.distance.size());
  const auto row = [&](std::vector<std::uint8_t>& of, int z) { return of.data() + columns.at(0, z); };
  for (int pass = 0; pass < kGroundReach; ++pass) {
    for (int z = 0; z < columns.z; ++z) {
      const std::uint8_t* from = row(columns.distance, z);
      std::uint8_t* to = row(along, z);
      for (int x = 0; x < columns.x; ++x)
        to[x] = std::min({from[std::max(x - 1, 0)], from[x], from[std::min(x + 1, columns.x - 1)]});
    }
    for (int z = 0; z < columns.z; ++z) {
      const std::uint8_t *here = row(along, z), *before = row(along, std::max(z - 1, 0)),
                         *after = row(along, std::min(z + 1, columns.z - 1));
      std::uint8_t* to = row(columns.distance, z);
      for (int x = 0; x < columns.x; ++x)
        to[x] = std::min(to[x], static_cast<std::uint8_t>(std::min({before[x], here[x], after[x]}) + 1));
    }
  }
}

}  // namespace

bool fits(const scene::Terrain& terrain, const state::Grid& grid) {
  return terrain.x == grid.x && terrain.z == grid.z &&
         terrain.height.size() == static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.z);
}

std::int32_t matter_amount(const state::Volume& volume, int x, int y, int z) {
  if (y >= volume.grid.y || !(volume.solid.test(x, y, z) || volume.liquid.test(x, y, z))) return 0;
  return std::min<std::int32_t>(volume.amount[volume.at(x, y, z)], kOne);
}

int puddle_floor(const state::Volume& volume, const Columns& columns, int x, int z) {
  const std::size_t c = columns.at(x, z);
  const int bed = columns.bed[c];
  return bed < volume.grid.y && volume.liquid.test(x, bed, z) ? bed : columns.top[c];
}

Columns find_columns(const state::Volume& volume, int smooth, const scene::Terrain& terrain,
                     cpu::Workers& workers) {
  const state::Grid& grid = volume.grid;
  const std::size_t count = static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.z);
  Columns columns;
  columns.x = grid.x;
  columns.z = grid.z;
  for (auto* of : {&columns.bed, &columns.top, &columns.offset, &columns.wet, &columns.shift})
    of->assign(count, 0);
  for (auto* of : {&columns.ground, &columns.wetness}) of->assign(count, 0.0f);
  columns.distance.assign(count, 0);

  const std::size_t leveled = smooth > 0 ? count : 0;
  Levels levels{grid.x, grid.z, std::vector<std::int32_t>(leveled, kNoLevel),
                std::vector<std::int32_t>(leveled, 0)};
  Finder finder(volume, fits(terrain, grid) ? &terrain : nullptr, columns, levels);
  std::vector<std::uint8_t> obstacles(static_cast<std::size_t>(grid.z), 0);
  workers.run(grid.z, [&](int z) { obstacles[static_cast<std::size_t>(z)] = finder.find(z) ? 1 : 0; });
  columns.obstacles = std::find(obstacles.begin(), obstacles.end(), 1) != obstacles.end();
  if (smooth > 0) columns.shift = level_shifts(levels, std::min(kLevelPasses * smooth, kMostLevelPasses));
  find_distances(columns);
  return columns;
}

}  // namespace voxmelt::render
