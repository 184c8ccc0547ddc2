#include "render/density/columns.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::render {
namespace {

using rule::kOne;

constexpr std::int32_t kFilm = kOne * 15 / 100;      // a film of this amount counts as fully wet
constexpr int kLevelPasses = 4;                      // passes along the surface of puddles for one in space
constexpr int kMostLevelPasses = 12;                 // at most; more would flatten domes
constexpr std::int32_t kSink = kOne * 4 / 10;        // sink of the surface into dry ground beside matter
constexpr std::int32_t kDive = kOne;                 // sink one cell further out
constexpr std::uint8_t kFarther = kGroundReach + 1;  // distance beyond any column that is filled

}  // namespace

// Looks at the columns of one column of bricks.
class Columns::Finder {
 public:
  Finder(const state::Volume& volume, const scene::Terrain* terrain, Columns& columns)
      : volume_(volume), terrain_(terrain), columns_(columns) {}

  void find(int bx, int bz, bool inert, Found& found) {
    const state::Grid& grid = volume_.grid;
    const std::size_t brick = columns_.brick_at(bx, bz);
    const CellBox box = cells_of(grid, {bx, 0, bz});
    std::int32_t read_to = 0;
    for (int z = box.low.z; z < box.high.z; ++z) {
      if (inert) find_inert(bx, z, box.high.x - box.low.x);
      for (int x = box.low.x; x < box.high.x; ++x) {
        const std::size_t c = columns_.at(x, z);
        const Stand before = columns_.stands_[c];
        if (inert) set_ground(x, z);
        find_matter(x, z, found);
        const Stand& now = columns_.stands_[c];
        if (covered(before) != covered(now)) found.wet.add(x, z);
        read_to = std::max(read_to, std::max(now.bed, now.end) + 1);
      }
    }
    columns_.read_to_[brick] = read_to;
    if (!inert) return;
    columns_.obstacles_[brick] = 0;
    for (int z = box.low.z; z < box.high.z; ++z)
      for (int x = box.low.x; x < box.high.x; ++x) {
        const Stand& stand = columns_.stands_[columns_.at(x, z)];
        if (stand.top > stand.bed) columns_.obstacles_[brick] = 1;
      }
  }

  static bool covered(const Stand& stand) { return stand.bed > 0 && (stand.film > 0 || stand.obstacle); }

 private:
  // Finds the first cell of each of eight columns that is not inert, and the cell above the last inert one.
  void find_inert(int bx, int z, int count) {
    const state::Grid& grid = volume_.grid;
    const auto eight = [&](int y) {
      return static_cast<unsigned>(volume_.inert.row(y, z)[static_cast<std::size_t>(bx) / 8] >> bx % 8 * 8) &
             0xff;
    };
    Stand* const stands = columns_.stands_.data() + columns_.at(bx * kBrickSide, z);
    for (int i = 0; i < count; ++i) {
      stands[i].bed = grid.y;
      stands[i].top = 0;
    }
    unsigned left = (1u << count) - 1;
    const auto take = [&](unsigned found, const auto& put) {
      for (int i = 0; i < count; ++i)
        if ((found >> i & 1) != 0) put(stands[i]);
      left &= ~found;
    };
    for (int y = 0; y < grid.y && left != 0; ++y)
      if (const unsigned found = left & ~eight(y); found != 0)
        take(found, [&](Stand& stand) { stand.bed = y; });
    left = (1u << count) - 1;
    for (int y = grid.y - 1; y >= 0 && left != 0; --y)
      if (const unsigned found = left & eight(y); found != 0)
        take(found, [&](Stand& stand) { stand.top = y + 1; });
  }

  void set_ground(int x, int z) {
    const std::size_t c = columns_.at(x, z);
    Stand& stand = columns_.stands_[c];
    if (terrain_ != nullptr)
      stand.bed = std::min(stand.bed, static_cast<std::int32_t>(std::clamp<long>(
                                          std::lround(terrain_->height[c]), 0, volume_.grid.y)));
    stand.top = std::max(stand.top, stand.bed);
    stand.obstacle = stand.bed < volume_.grid.y && volume_.inert.test(x, stand.bed, z);
  }

  // Finds the matter on the bed, and the level of the liquid that rests on ground or obstacle under open air.
  void find_matter(int x, int z, Found& found) {
    const std::size_t c = columns_.at(x, z);
    Stand& stand = columns_.stands_[c];
    const int ny = volume_.grid.y;
    const std::size_t word = static_cast<std::size_t>(x) / 64, words = volume_.liquid.row_words();
    const std::uint64_t* const liquid = volume_.liquid.row(0, z).data() + word;
    const std::uint64_t* const solid = volume_.solid.row(0, z).data() + word;
    const std::uint16_t* const amounts = volume_.amount.data() + volume_.at(x, 0, z).offset;
    const std::size_t step = volume_.amount.layout().row();
    const auto is = [&](const std::uint64_t* plane, int y) { return (plane[y * words] >> x % 64 & 1) != 0; };
    const auto amount = [&](int y) { return std::min<std::int32_t>(amounts[y * step], kOne); };
    const bool wet = stand.bed < ny && is(liquid, stand.bed);
    stand.offset = offset(volume_, x, stand.bed, z);
    const std::int32_t on_bed = wet || (stand.bed < ny && is(solid, stand.bed)) ? amount(stand.bed) : 0;
    stand.film = stand.bed > 0 ? std::min(on_bed, kFilm) * kOne / kFilm : 0;
    columns_.ground_[c] = stand.bed * kOne + stand.offset;
    columns_.wetness_[c] = stand.film;
    stand.floor = wet ? stand.bed : stand.top;
    std::int32_t depth = 0, level = kNoLevel;
    int y = stand.floor;
    for (; y < ny && is(liquid, y); ++y) depth += amount(y);
    stand.end = y;

    PuddleLevels& levels = columns_.levels_;
    if (levels.level.empty()) return;
    if (stand.floor == 0 || depth == 0 || y == ny || volume_.inert.test(x, y, z) ||
        (is(solid, y) && amount(y) != 0))
      depth = 0;
    else
      level = stand.floor * kOne + (stand.floor == stand.bed ? stand.offset : 0) + depth;
    if (levels.level[c] == level && levels.depth[c] == depth) return;
    levels.level[c] = level;
    levels.depth[c] = depth;
    found.levels.add(x, z);
  }

 public:
  static std::int32_t offset(const state::Volume& volume, int x, int bed, int z) {
    if (bed == 0) return 0;
    return std::clamp<std::int32_t>(volume.amount[volume.at(x, bed - 1, z)] - rule::kBedHalf, -kOne / 2,
                                    kOne / 2);
  }

 private:
  const state::Volume& volume_;
  const scene::Terrain* terrain_;  // null if there is none
  Columns& columns_;
};

std::int32_t Plan::high() const { return std::max(rise != kNoGround ? bed + 1 : 0, puddle() ? end + 1 : 0); }

void Extent::add(std::int32_t from, std::int32_t to) {
  if (from >= to) return;
  low = std::min(low, from);
  high = std::max(high, to);
}

Columns::Columns(const state::Grid& grid)
    : grid_(grid),
      bricks_(brick_grid(grid)),
      stands_(static_cast<std::size_t>(grid.x) * grid.z),
      shifts_(stands_.size(), 0),
      distances_(stands_.size(), kFarther),
      plans_(stands_.size()),
      ground_(stands_.size(), 0),
      wetness_(stands_.size(), 0),
      planned_(static_cast<std::size_t>(bricks_.x) * bricks_.z),
      another_(planned_),
      read_to_(planned_.size(), 1),
      obstacles_(planned_.size(), 0) {
  levels_.x = grid.x;
  levels_.z = grid.z;
}

bool Columns::has_obstacles() const {
  return std::find(obstacles_.begin(), obstacles_.end(), 1) != obstacles_.end();
}

bool Columns::same_offsets(const state::Volume& volume, const state::Grid& brick) const {
  const CellBox box = cells_of(grid_, brick);
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int x = box.low.x; x < box.high.x; ++x) {
      const Stand& stand = stands_[at(x, z)];
      if (stand.bed > box.low.y && stand.bed <= box.high.y &&
          Finder::offset(volume, x, stand.bed, z) != stand.offset)
        return false;
    }
  return true;
}

const std::vector<Extent>& Columns::update(const state::Volume& volume, int smooth,
                                           const scene::Terrain& terrain, const News& news,
                                           cpu::Workers& workers, const Loops& with) {
  const std::size_t leveled = smooth > 0 ? stands_.size() : 0;
  if (levels_.level.size() != leveled) {
    levels_.level.assign(leveled, kNoLevel);
    levels_.depth.assign(leveled, 0);
    std::fill(shifts_.begin(), shifts_.end(), 0);
  }

  std::vector<Found> found(bricks_.z);
  std::vector<std::uint8_t> looked(planned_.size(), 0);
  workers.run(bricks_.z, [&](int bz) {
    Finder finder(volume, fits(terrain, grid_) ? &terrain : nullptr, *this);
    for (int bx = 0; bx < bricks_.x; ++bx) {
      const std::size_t brick = brick_at(bx, bz);
      another_[brick] = {};
      const std::uint8_t look = news.everything ? std::uint8_t{kInert} : news.look[brick];
      if (look == kNothing) continue;
      looked[brick] = 1;
      finder.find(bx, bz, look == kInert, found[bz]);
    }
  });

  ColumnBox levels = ColumnBox::none(), wet = ColumnBox::none();
  const auto unite = [](ColumnBox& to, const ColumnBox& box) {
    if (!box.empty()) {
      to.add(box.low_x, box.low_z);
      to.add(box.high_x - 1, box.high_z - 1);
    }
  };
  for (const Found& one : found) {
    unite(levels, one.levels);
    unite(wet, one.wet);
  }
  const int passes = std::min(kLevelPasses * smooth, kMostLevelPasses);
  if (news.everything) levels = wet = {0, 0, grid_.x, grid_.z};
  if (!levels.empty()) levels = levels.widened(passes, grid_.x, grid_.z);
  if (!wet.empty()) wet = wet.widened(kGroundReach, grid_.x, grid_.z);
  if (leveled != 0) find_shifts(levels_, passes, levels, shifts_, with);
  find_distances(wet);

  const auto near = [](const ColumnBox& box, int bx, int bz) {
    return !box.empty() && bx * kBrickSide < box.high_x && (bx + 1) * kBrickSide > box.low_x &&
           bz * kBrickSide < box.high_z && (bz + 1) * kBrickSide > box.low_z;
  };
  workers.run(bricks_.z, [&](int bz) {
    for (int bx = 0; bx < bricks_.x; ++bx)
      if (looked[brick_at(bx, bz)] != 0 || near(levels, bx, bz) || near(wet, bx, bz)) find_plans(bx, bz);
  });
  return another_;
}

// Finds distances of largest |dx|, |dz|, along x and then along z. A wet column reaches kGroundReach columns.
void Columns::find_distances(const ColumnBox& box) {
  if (box.empty()) return;
  const ColumnBox wide = box.widened(kGroundReach, grid_.x, grid_.z);
  const int width = wide.high_x - wide.low_x;
  std::vector<std::uint8_t> along(static_cast<std::size_t>(width) * (wide.high_z - wide.low_z));
  const auto place = [&](int x, int z) {
    return static_cast<std::size_t>(z - wide.low_z) * width + (x - wide.low_x);
  };
  for (int z = wide.low_z; z < wide.high_z; ++z) {
    int last = -kFarther;  // the last wet column to the left
    for (int x = wide.low_x; x < wide.high_x; ++x) {
      if (Finder::covered(stands_[at(x, z)])) last = x;
      along[place(x, z)] = static_cast<std::uint8_t>(std::min<int>(x - last, kFarther));
    }
    last = wide.high_x + kFarther;
    for (int x = wide.high_x - 1; x >= wide.low_x; --x) {
      if (Finder::covered(stands_[at(x, z)])) last = x;
      std::uint8_t& to = along[place(x, z)];
      to = static_cast<std::uint8_t>(std::min<int>(to, last - x));
    }
  }
  for (int z = box.low_z; z < box.high_z; ++z)
    for (int x = box.low_x; x < box.high_x; ++x) {
      int nearest = kFarther;
      for (int dz = -kGroundReach; dz <= kGroundReach; ++dz)
        if (z + dz >= wide.low_z && z + dz < wide.high_z)
          nearest = std::min(nearest, std::max<int>(std::abs(dz), along[place(x, z + dz)]));
      distances_[at(x, z)] = static_cast<std::uint8_t>(nearest);
    }
}

void Columns::find_plans(int bx, int bz) {
  const CellBox box = cells_of(grid_, {bx, 0, bz});
  const std::size_t brick = brick_at(bx, bz);
  Extent planned, another;
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int x = box.low.x; x < box.high.x; ++x) {
      const std::size_t c = at(x, z);
      const Stand& stand = stands_[c];
      Plan plan;
      plan.bed = stand.bed;
      if (stand.bed > 0 && distances_[c] <= kGroundReach) {
        const std::int32_t wet = stand.obstacle ? kOne : stand.film;
        const std::int32_t sink = distances_[c] < kGroundReach ? kSink - kSink * wet / kOne : kDive;
        plan.rise = stand.offset - sink;
        if (stand.obstacle) plan.rise = std::max(plan.rise, 0);  // an obstacle stands without a gap
      }
      // The bed lies above or below its cell's top face by a part of a cell. The liquid on it is moved by the
      // same part. Otherwise the terraces of the voxelised ground would show through its surface.
      const bool on_bed = stand.floor == stand.bed && plan.rise != Plan::kNoGround;
      const std::int32_t shift = shifts_[c] + (on_bed ? plan.rise : 0);
      if (stand.end > stand.floor && (on_bed || (stand.floor > stand.bed && shift != 0))) {
        plan.floor = stand.floor;
        plan.end = stand.end;
        plan.shift = std::clamp(shift, -kOne, kOne);
      }
      Plan& old = plans_[c];
      planned.add(plan.low(), plan.high());
      if (plan == old) continue;
      // If both fill the ground, only its uppermost cells differ.
      const bool both = plan.rise != Plan::kNoGround && old.rise != Plan::kNoGround;
      another.add(both ? std::max(std::min(plan.bed, old.bed) - 2, 0) : std::min(plan.low(), old.low()),
                  std::max(plan.high(), old.high()));
      old = plan;
    }
  planned_[brick] = planned;
  another_[brick] = another;
}

bool fits(const scene::Terrain& terrain, const state::Grid& grid) {
  return terrain.x == grid.x && terrain.z == grid.z &&
         terrain.height.size() == static_cast<std::size_t>(grid.x) * grid.z;
}

}  // namespace voxmelt::render
