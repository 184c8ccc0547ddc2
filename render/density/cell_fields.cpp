#include "render/density/cell_fields.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "kernel/rule/fixed_point.h"
#include "render/density/levels.h"

namespace voxmelt::render {
namespace {

using rule::kOne;

constexpr std::int32_t kFilm = kOne * 15 / 100;  // a film of this amount counts as fully wet
constexpr std::int32_t kSink = kOne * 4 / 10;    // how far the surface sinks into dry ground beside matter
constexpr std::int32_t kDive = kOne;             // ... and one cell further out
constexpr int kLevelPasses = 4;                  // passes along the surface of puddles for one in space
constexpr int kMostLevelPasses = 12;             // ... more would flatten domes
constexpr int kReach = 2;                        // columns around matter whose ground is filled

std::uint16_t intensity_of(std::int32_t amount) {
  return static_cast<std::uint16_t>(std::clamp(amount, 0, kOne) * kFull / kOne);
}

// The ground of every column, [z][x].
struct Columns {
  std::vector<int> bed;              // cells of ground, counted up from y = 0
  std::vector<int> top;              // the first cell above ground and obstacles
  std::vector<std::int32_t> offset;  // of the true ground from the top face of its cell, in kOne
  std::vector<std::int32_t> wet;     // 0..kOne: covered by matter or an obstacle
  std::vector<std::int32_t> shift;   // of the puddle, to take out its terraces, in kOne
};

class Builder {
 public:
  Builder(const state::Volume& volume, const scene::Terrain& terrain)
      : volume_(volume), terrain_(fits(terrain, volume.grid) ? &terrain : nullptr), grid_(volume.grid) {}

  CellFields build(int smooth) {
    fields_.grid = grid_;
    for (auto* field : {&fields_.intensity, &fields_.solid, &fields_.liquid, &fields_.heat})
      field->assign(grid_.cells(), 0);
    fields_.ground.assign(column_count(), 0.0f);
    fields_.wetness.assign(column_count(), 0.0f);
    find_matter();
    find_ground();
    find_shifts(smooth);
    for (int z = 0; z < grid_.z; ++z)
      for (int x = 0; x < grid_.x; ++x) fill_ground(x, z);
    return std::move(fields_);
  }

 private:
  std::size_t column_count() const {
    return static_cast<std::size_t>(grid_.x) * static_cast<std::size_t>(grid_.z);
  }
  std::size_t column(int x, int z) const { return grid_.index(x, 0, 0) + column_row(z); }
  std::size_t column_row(int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_.x);
  }

  std::int32_t matter_amount(int x, int y, int z) const {
    if (y >= grid_.y || !(volume_.solid.test(x, y, z) || volume_.liquid.test(x, y, z))) return 0;
    return std::min<std::int32_t>(volume_.amount[volume_.at(x, y, z)], kOne);
  }

  void find_matter() {
    for (int z = 0; z < grid_.z; ++z)
      for (int y = 0; y < grid_.y; ++y)
        for (int x = 0; x < grid_.x; ++x) {
          const std::size_t i = grid_.index(x, y, z);
          const state::Slot slot = volume_.at(x, y, z);
          if (volume_.amount[slot] == 0 || volume_.inert.test(x, y, z)) continue;
          const std::uint16_t value = intensity_of(volume_.amount[slot]);
          fields_.intensity[i] = value;
          if (volume_.solid.test(x, y, z)) {
            fields_.solid[i] = value;
          } else {
            fields_.liquid[i] = value;
            fields_.heat[i] = static_cast<std::uint16_t>(static_cast<std::uint32_t>(value) *
                                                         volume_.temperature[slot] / rule::kTemperatureMax);
          }
        }
  }

  void find_ground() {
    columns_.bed.assign(column_count(), 0);
    columns_.top.assign(column_count(), 0);
    columns_.offset.assign(column_count(), 0);
    columns_.wet.assign(column_count(), 0);
    for (int z = 0; z < grid_.z; ++z)
      for (int x = 0; x < grid_.x; ++x) {
        const std::size_t c = column(x, z);
        const int highest =
            terrain_ ? std::min(static_cast<int>(std::lround(terrain_->height[c])), grid_.y) : grid_.y;
        int bed = 0;
        while (bed < highest && volume_.inert.test(x, bed, z)) ++bed;
        columns_.bed[c] = bed;
        columns_.top[c] = fill_obstacles(x, bed, z);
        if (bed == 0) continue;
        columns_.offset[c] = std::clamp<std::int32_t>(
            volume_.amount[volume_.at(x, bed - 1, z)] - rule::kBedHalf, -kOne / 2, kOne / 2);
        fields_.ground[c] =
            static_cast<float>(bed) + static_cast<float>(columns_.offset[c]) / static_cast<float>(kOne);
        columns_.wet[c] = std::min(matter_amount(x, bed, z), kFilm) * kOne / kFilm;
        fields_.wetness[c] = static_cast<float>(columns_.wet[c]) / static_cast<float>(kOne);
        if (on_bed(fields_.obstacle, x, bed, z)) columns_.wet[c] = kOne;
      }
  }

  bool on_bed(const std::vector<std::uint16_t>& field, int x, int bed, int z) const {
    return !field.empty() && bed < grid_.y && field[grid_.index(x, bed, z)] != 0;
  }

  // The cell in which the puddle of a column begins: on the bed, or else on the highest obstacle.
  int puddle_floor(int x, int z) const {
    const std::size_t c = column(x, z);
    const int bed = columns_.bed[c];
    return bed < grid_.y && volume_.liquid.test(x, bed, z) ? bed : columns_.top[c];
  }

  // The level of the liquid that rests on ground or obstacle under open air, smoothed along the surface.
  void find_shifts(int smooth) {
    columns_.shift.assign(column_count(), 0);
    if (smooth <= 0) return;
    Levels levels{grid_.x, grid_.z, std::vector<std::int32_t>(column_count(), kNoLevel),
                  std::vector<std::int32_t>(column_count(), 0)};
    for (int z = 0; z < grid_.z; ++z)
      for (int x = 0; x < grid_.x; ++x) {
        const std::size_t c = column(x, z);
        const int floor = puddle_floor(x, z);
        int y = floor;
        if (y == 0) continue;
        std::int32_t depth = 0;
        for (; y < grid_.y && volume_.liquid.test(x, y, z); ++y) depth += matter_amount(x, y, z);
        if (depth == 0 || y == grid_.y || fields_.intensity[grid_.index(x, y, z)] != 0) continue;
        levels.depth[c] = depth;
        levels.level[c] = floor * kOne + (floor == columns_.bed[c] ? columns_.offset[c] : 0) + depth;
      }
    columns_.shift = level_shifts(levels, std::min(kLevelPasses * smooth, kMostLevelPasses));
  }

  // Returns the first cell above the bed and all obstacles.
  int fill_obstacles(int x, int bed, int z) {
    int top = bed;
    for (int y = bed; y < grid_.y; ++y)
      if (volume_.inert.test(x, y, z)) {
        if (fields_.obstacle.empty()) fields_.obstacle.assign(grid_.cells(), 0);
        const std::size_t i = grid_.index(x, y, z);
        fields_.intensity[i] = fields_.obstacle[i] = static_cast<std::uint16_t>(kFull);
        top = y + 1;
      }
    return top;
  }

  // Distance in columns (largest of |dx|, |dz|) to the nearest wet column, kReach + 1 where there is none.
  int distance_to_wet(int x, int z) const {
    if (columns_.wet[column(x, z)] > 0) return 0;
    int nearest = kReach + 1;
    for (int nz = std::max(z - kReach, 0); nz <= std::min(z + kReach, grid_.z - 1); ++nz)
      for (int nx = std::max(x - kReach, 0); nx <= std::min(x + kReach, grid_.x - 1); ++nx)
        if (columns_.wet[column(nx, nz)] > 0)
          nearest = std::min(nearest, std::max(std::abs(nx - x), std::abs(nz - z)));
    return nearest;
  }

  void fill_ground(int x, int z) {
    const std::size_t c = column(x, z);
    const int bed = columns_.bed[c];
    if (const int floor = puddle_floor(x, z); floor > bed) shift_liquid(x, floor, z, columns_.shift[c]);
    if (bed == 0) return;
    const int distance = distance_to_wet(x, z);
    if (distance > kReach) return;
    const std::int32_t sink = distance < kReach ? kSink - kSink * columns_.wet[c] / kOne : kDive;
    std::int32_t rise = columns_.offset[c] - sink;
    if (on_bed(fields_.obstacle, x, bed, z))
      rise = std::max(rise, 0);  // an obstacle stands on it without a gap

    // Ground up to the true height of the bed, less the sink.
    const int last = std::min(bed, grid_.y - 1);
    for (int y = 0; y <= last; ++y) {
      const std::size_t i = grid_.index(x, y, z);
      const std::int32_t ground = std::clamp((bed - y) * kOne + rise, 0, kOne);
      fields_.intensity[i] = std::max(fields_.intensity[i], intensity_of(ground));
    }
    if (bed < grid_.y && volume_.liquid.test(x, bed, z)) shift_liquid(x, bed, z, rise + columns_.shift[c]);
  }

  // The liquid that rests on the bed is moved up or down by the part of a cell by which the bed lies above or
  // below its cell's top face; otherwise the terraces of the voxelised ground show through its surface.
  void shift_liquid(int x, int bed, int z, std::int32_t rise) {
    int top = bed;
    while (top < grid_.y && volume_.liquid.test(x, top, z)) ++top;
    const auto amount_at = [&](int y) {
      return y < bed ? kOne : (y < top ? matter_amount(x, y, z) : std::int32_t{0});
    };
    const std::int32_t shift = std::clamp(rise, -kOne, kOne);
    const int first = shift < 0 ? bed - 1 : bed;
    for (int y = first; y <= std::min(top, grid_.y - 1); ++y) {
      const std::size_t i = grid_.index(x, y, z);
      if (y == top && fields_.intensity[i] != 0) break;  // something else rests on the liquid
      const std::int32_t other = shift < 0 ? amount_at(y + 1) : amount_at(y - 1);
      const std::int32_t part = std::abs(shift);
      fields_.intensity[i] = intensity_of((amount_at(y) * (kOne - part) + other * part) / kOne);
    }
  }

  const state::Volume& volume_;
  const scene::Terrain* terrain_;  // null where it does not fit
  state::Grid grid_;
  CellFields fields_;
  Columns columns_;
};

}  // namespace

bool fits(const scene::Terrain& terrain, const state::Grid& grid) {
  return terrain.x == grid.x && terrain.z == grid.z &&
         terrain.height.size() == static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.z);
}

CellFields cell_fields(const state::Volume& volume, int smooth, const scene::Terrain& terrain) {
  return Builder(volume, terrain).build(smooth);
}

}  // namespace voxmelt::render
