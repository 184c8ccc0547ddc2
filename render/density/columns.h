// Each column of the grid holds something, and is drawn by a plan. The plan says how far the ground is
// filled, and by how much the puddle on it is moved.
//
// The ground is the inert cells that reach up from y = 0, no higher than the terrain if that is known. Every
// other inert cell is part of an obstacle, which is drawn like a solid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/brick.h"
#include "render/density/levels.h"
#include "render/density/loops.h"

namespace voxmelt::render {

inline constexpr int kGroundReach = 2;  // columns around matter whose ground is filled

// Describes what stands on a column. Heights below one cell are in rule::kOne.
struct Stand {
  std::int32_t bed = 0;     // cells of ground, counted up from y = 0
  std::int32_t top = 0;     // the first cell above ground and obstacles
  std::int32_t floor = 0;   // the cell in which the puddle begins: on the bed, or else on the obstacle
  std::int32_t end = 0;     // the first cell from there on that is not liquid
  std::int32_t offset = 0;  // from the top face of its cell to the true ground
  std::int32_t film = 0;    // 0 dry ground .. kOne: covered by at least a thin film
  bool obstacle = false;    // true if an obstacle stands on the bed itself
  friend bool operator==(const Stand&, const Stand&) = default;
};

// Describes what is written into the cells of a column beyond its matter and obstacles.
struct Plan {
  static constexpr std::int32_t kNoGround = INT32_MIN;

  std::int32_t bed = 0, rise = kNoGround;  // the ground is filled to the bed plus the rise
  std::int32_t floor = 0, end = 0;         // the puddle that is moved; none if floor = end
  std::int32_t shift = 0;                  // distance by which the puddle is moved
  friend bool operator==(const Plan&, const Plan&) = default;

  bool puddle() const { return floor < end; }
  // It writes no cells but those from low to high - 1.
  std::int32_t low() const { return rise != kNoGround ? 0 : puddle() ? floor - 1 : INT32_MAX; }
  std::int32_t high() const;
};

// Bounds cells of a column of bricks, from low to high.
struct Extent {
  std::int32_t low = INT32_MAX, high = INT32_MIN;
  bool empty() const { return low >= high; }
  void add(std::int32_t from, std::int32_t to);
};

class Columns {
 public:
  Columns() = default;
  explicit Columns(const state::Grid& grid);  // columns of an empty volume

  // Tells the next update what to look at. `brick` is one of the columns of bricks, [z][x].
  enum Look : std::uint8_t { kNothing, kMatter, kInert };  // kInert covers inert cells, too
  struct News {
    std::vector<std::uint8_t> look;  // per column of bricks
    bool everything = false;         // set by another terrain or another smoothing
  };

  // Brings everything up to date. Returns for each column of bricks the cells whose plan differs.
  const std::vector<Extent>& update(const state::Volume& volume, int smooth, const scene::Terrain& terrain,
                                    const News& news, cpu::Workers& workers, const Loops& with);

  // Tells whether the ground kept its height, as far as the marked brick holds it.
  bool same_offsets(const state::Volume& volume, const state::Grid& brick) const;

  std::size_t at(int x, int z) const { return static_cast<std::size_t>(z) * grid_.x + x; }
  std::size_t brick_at(int bx, int bz) const { return static_cast<std::size_t>(bz) * bricks_.x + bx; }
  const Stand& stand(std::size_t column) const { return stands_[column]; }
  const Plan& plan(std::size_t column) const { return plans_[column]; }
  const Extent& planned(std::size_t brick) const { return planned_[brick]; }  // cells that its plans write
  // Returns the end of the cells on which stands depend.
  std::int32_t read_to(std::size_t brick) const { return read_to_[brick]; }
  bool has_obstacles(std::size_t brick) const { return obstacles_[brick] != 0; }
  bool has_obstacles() const;
  const std::vector<std::int32_t>& ground() const { return ground_; }    // [z][x], 1/4096 cell, 0 for none
  const std::vector<std::int32_t>& wetness() const { return wetness_; }  // [z][x], 0..4096

  friend bool operator==(const Columns& a, const Columns& b) {
    return a.stands_ == b.stands_ && a.plans_ == b.plans_;
  }

 private:
  class Finder;
  struct Found {
    ColumnBox levels = ColumnBox::none(), wet = ColumnBox::none();
  };

  void find_distances(const ColumnBox& box);
  void find_plans(int bx, int bz);

  state::Grid grid_, bricks_;
  std::vector<Stand> stands_;
  PuddleLevels levels_;  // empty if puddles are not smoothed
  std::vector<std::int32_t> shifts_;
  std::vector<std::uint8_t> distances_;  // to the nearest wet column, at most kGroundReach + 1
  std::vector<Plan> plans_;
  std::vector<std::int32_t> ground_, wetness_;
  std::vector<Extent> planned_, another_;
  std::vector<std::int32_t> read_to_;
  std::vector<std::uint8_t> obstacles_;
};

// Tells whether a terrain has a height for every column of the grid. Only then it says what is ground. If all
// heights are zero, no cell is ground.
bool fits(const scene::Terrain& terrain, const state::Grid& grid);

}  // namespace voxmelt::render
