// Computes the contribution of each cell before filtering, column by column.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/fixed_point.h"
#include "tests/render/plain_field.h"

namespace voxmelt::test {
namespace {

using rule::kOne;

constexpr std::int32_t kFilm = kOne * 15 / 100, kSink = kOne * 4 / 10, kDive = kOne;
constexpr int kReach = 2;

std::uint16_t intensity_of(std::int32_t amount) {
  return static_cast<std::uint16_t>(std::clamp(amount, 0, kOne) * render::kFull / kOne);
}

class Builder {
 public:
  Builder(const state::Volume& volume, const scene::Terrain& terrain)
      : volume_(volume),
        terrain_(render::fits(terrain, volume.grid) ? &terrain : nullptr),
        grid_(volume.grid),
        columns_(static_cast<std::size_t>(grid_.x) * static_cast<std::size_t>(grid_.z)),
        bed_(columns_, 0),
        top_(columns_, 0),
        offset_(columns_, 0),
        wet_(columns_, 0),
        shift_(columns_, 0) {}

  PlainCells build(int smooth) {
    for (Cells* cells : {&to_.intensity, &to_.solid, &to_.liquid, &to_.heat, &to_.obstacle})
      cells->assign(grid_.cells(), 0);
    to_.ground.assign(columns_, 0);
    to_.wetness.assign(columns_, 0);
    for (int z = 0; z < grid_.z; ++z)
      for (int y = 0; y < grid_.y; ++y)
        for (int x = 0; x < grid_.x; ++x) put_matter(x, y, z);
    each_column([&](int x, int z) { find_ground(x, z); });
    if (smooth > 0) find_shifts(smooth);
    each_column([&](int x, int z) { fill_ground(x, z); });
    return std::move(to_);
  }

 private:
  template <class Action>
  void each_column(const Action& action) const {
    for (int z = 0; z < grid_.z; ++z)
      for (int x = 0; x < grid_.x; ++x) action(x, z);
  }
  std::size_t column(int x, int z) const {
    return static_cast<std::size_t>(z) * static_cast<std::size_t>(grid_.x) + static_cast<std::size_t>(x);
  }
  bool liquid(int x, int y, int z) const { return y < grid_.y && volume_.liquid.test(x, y, z); }
  bool inert(int x, int y, int z) const { return y < grid_.y && volume_.inert.test(x, y, z); }
  std::int32_t amount(int x, int y, int z) const {
    if (y >= grid_.y || !(volume_.solid.test(x, y, z) || volume_.liquid.test(x, y, z))) return 0;
    return std::min<std::int32_t>(volume_.amount[volume_.at(x, y, z)], kOne);
  }

  void put_matter(int x, int y, int z) {
    const std::size_t i = grid_.index(x, y, z);
    const std::uint16_t value = intensity_of(amount(x, y, z));
    to_.intensity[i] = value;
    if (volume_.solid.test(x, y, z)) to_.solid[i] = value;
    if (!volume_.liquid.test(x, y, z)) return;
    to_.liquid[i] = value;
    to_.heat[i] =
        static_cast<std::uint16_t>(std::uint64_t{value} * volume_.heat[volume_.at(x, y, z)] / 65536);
  }

  void find_ground(int x, int z) {
    const std::size_t c = column(x, z);
    const int highest =
        terrain_ ? std::min(static_cast<int>(std::lround(terrain_->height[c])), grid_.y) : grid_.y;
    int bed = 0;
    while (bed < highest && inert(x, bed, z)) ++bed;
    bed_[c] = top_[c] = bed;
    for (int y = bed; y < grid_.y; ++y) {
      if (!inert(x, y, z)) continue;
      const std::size_t i = grid_.index(x, y, z);
      to_.intensity[i] = to_.obstacle[i] = static_cast<std::uint16_t>(render::kFull);
      top_[c] = y + 1;
    }
    if (bed == 0) return;
    offset_[c] = std::clamp<std::int32_t>(volume_.amount[volume_.at(x, bed - 1, z)] - rule::kBedHalf,
                                          -kOne / 2, kOne / 2);
    to_.ground[c] = bed * kOne + offset_[c];
    wet_[c] = std::min(amount(x, bed, z), kFilm) * kOne / kFilm;
    to_.wetness[c] = wet_[c];
    if (inert(x, bed, z)) wet_[c] = kOne;
  }

  int puddle_floor(int x, int z) const {
    const int bed = bed_[column(x, z)];
    return liquid(x, bed, z) ? bed : top_[column(x, z)];
  }

  void find_shifts(int smooth) {
    render::PuddleLevels levels{grid_.x, grid_.z, std::vector<std::int32_t>(columns_, render::kNoLevel),
                                std::vector<std::int32_t>(columns_, 0)};
    each_column([&](int x, int z) {
      const std::size_t c = column(x, z);
      const int floor = puddle_floor(x, z);
      if (floor == 0) return;
      std::int32_t depth = 0;
      int y = floor;
      for (; liquid(x, y, z); ++y) depth += amount(x, y, z);
      if (depth == 0 || y == grid_.y || to_.intensity[grid_.index(x, y, z)] != 0) return;
      levels.depth[c] = depth;
      levels.level[c] = floor * kOne + (floor == bed_[c] ? offset_[c] : 0) + depth;
    });
    shift_ = plain_level_shifts(levels, std::min(4 * smooth, 12));
  }

  int distance_to_wet(int x, int z) const {
    int nearest = kReach + 1;
    each_column([&](int nx, int nz) {
      if (wet_[column(nx, nz)] > 0) nearest = std::min(nearest, std::max(std::abs(nx - x), std::abs(nz - z)));
    });
    return nearest;
  }

  void fill_ground(int x, int z) {
    const std::size_t c = column(x, z);
    const int bed = bed_[c];
    if (const int floor = puddle_floor(x, z); floor > bed) shift_liquid(x, floor, z, shift_[c]);
    if (bed == 0) return;
    const int distance = distance_to_wet(x, z);
    if (distance > kReach) return;
    std::int32_t rise = offset_[c] - (distance < kReach ? kSink - kSink * wet_[c] / kOne : kDive);
    if (inert(x, bed, z)) rise = std::max(rise, 0);
    for (int y = 0; y <= std::min(bed, grid_.y - 1); ++y) {
      std::uint16_t& to = to_.intensity[grid_.index(x, y, z)];
      to = std::max(to, intensity_of((bed - y) * kOne + rise));
    }
    if (liquid(x, bed, z)) shift_liquid(x, bed, z, rise + shift_[c]);
  }

  void shift_liquid(int x, int bed, int z, std::int32_t rise) {
    int top = bed;
    while (liquid(x, top, z)) ++top;
    const auto here = [&](int y) { return y < bed ? kOne : (y < top ? amount(x, y, z) : std::int32_t{0}); };
    const std::int32_t shift = std::clamp(rise, -kOne, kOne), part = std::abs(shift);
    for (int y = shift < 0 ? bed - 1 : bed; y <= std::min(top, grid_.y - 1); ++y) {
      std::uint16_t& to = to_.intensity[grid_.index(x, y, z)];
      if (y == top && to != 0) break;
      to = intensity_of((here(y) * (kOne - part) + here(shift < 0 ? y + 1 : y - 1) * part) / kOne);
    }
  }

  const state::Volume& volume_;
  const scene::Terrain* terrain_;
  state::Grid grid_;
  std::size_t columns_;
  std::vector<int> bed_, top_;
  std::vector<std::int32_t> offset_, wet_, shift_;
  PlainCells to_;
};

}  // namespace

PlainCells plain_cells(const state::Volume& volume, int smooth, const scene::Terrain& terrain) {
  return Builder(volume, terrain).build(smooth);
}

}  // namespace voxmelt::test
