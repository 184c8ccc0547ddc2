#include "render/packet/field_bricks.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "render/packet/block_distances.h"
#include "render/rule/matter.h"

namespace voxmelt::render {
namespace {

constexpr std::size_t kPlaces = kBrickVolume;
constexpr std::uint8_t kWhole = 2;  // marks a brick that is filled even if unchanged
constexpr std::int32_t kAirBlock = INT32_MIN;
constexpr std::size_t kBeyond = 16;  // levels are read in pairs, and in rows of 16
static_assert(kPlacesOfBrick == kBrickPlaces);

// Describes a brick of the field.
BrickSource source_of(const state::Grid& grid, const state::Grid& brick) {
  const state::Grid first{brick.x * kBrickSide, brick.y * kBrickSide, brick.z * kBrickSide};
  BrickSource source;
  for (int i = 0; i < BrickSource::kWide; ++i) {
    source.rows[i] = grid.index(0, std::clamp(first.y + i - 1, 0, grid.y - 1), 0);
    source.slices[i] = grid.index(0, 0, std::clamp(first.z + i - 1, 0, grid.z - 1));
  }
  source.x = first.x;
  source.cells_x = grid.x;
  source.count_x = std::min(kBrickSide, grid.x - first.x);
  source.count_y = std::min(kBrickSide, grid.y - first.y);
  source.count_z = std::min(kBrickSide, grid.z - first.z);
  return source;
}

// The next brick of the lattice holds these planes of a brick of the field, too.
constexpr std::uint8_t kLastPlanes = 0xE0;

// Calls visit(b) for the bricks from `a` to the next ones, along those axes on which `more` is 1.
template <class Visit>
void for_near(const state::Grid& bricks, const state::Grid& a, const state::Grid& more, const Visit& visit) {
  for (int z = a.z; z <= std::min(a.z + more.z, bricks.z - 1); ++z)
    for (int y = a.y; y <= std::min(a.y + more.y, bricks.y - 1); ++y)
      for (int x = a.x; x <= std::min(a.x + more.x, bricks.x - 1); ++x) visit(state::Grid{x, y, z});
}
// Calls visit(b) for the bricks at the offsets `low` to `high` from brick `a`. Each of them has places in
// common with it.
template <class Visit>
void for_near(const state::Grid& bricks, const state::Grid& a, int low, int high, const Visit& visit) {
  for (int z = std::max(a.z + low, 0); z <= std::min(a.z + high, bricks.z - 1); ++z)
    for (int y = std::max(a.y + low, 0); y <= std::min(a.y + high, bricks.y - 1); ++y)
      for (int x = std::max(a.x + low, 0); x <= std::min(a.x + high, bricks.x - 1); ++x)
        visit(state::Grid{x, y, z});
}

state::Grid place_in(const state::Grid& bricks, std::size_t brick) {
  const auto x = static_cast<std::size_t>(bricks.x), y = static_cast<std::size_t>(bricks.y);
  return {static_cast<int>(brick % x), static_cast<int>(brick / x % y), static_cast<int>(brick / x / y)};
}

// Returns the byte of heat by the mean in what carries it, in 256 steps.
std::array<std::uint8_t, 257> heats_of(const picture::Look& look) {
  std::array<std::uint8_t, 257> values{};
  for (std::int32_t i = 0; i <= 256; ++i) {
    const picture::Matter matter =
        look.tinted() ? picture::matter_of(256, 0, i, 0, look) : picture::matter_of(0, 256, i, 0, look);
    values[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(matter.heat);
  }
  return values;
}

}  // namespace

void FieldBricks::resize(const state::Grid& grid) {
  grid_ = grid;
  cells_ = {grid.x, grid.y, grid.z};
  const auto bricks = [](int side) { return (side + 2) / kBrickSide + 1; };
  bricks_ = {bricks(grid.x), bricks(grid.y), bricks(grid.z)};
  blocks_ = {2 * bricks_.x, 2 * bricks_.y, 2 * bricks_.z};
  slots_.assign(bricks_.cells(), 0);
  free_.clear();
  levels_.assign(kPlaces + kBeyond, picture::kAir);
  matter_.assign(kPlaces, 0);
  records_.assign(blocks_.cells(), kAirBlock | kFarthest);
  occupied_.assign(blocks_.cells(), 0);
}

void FieldBricks::update(const DensityField& field, const picture::Look& look,
                         const std::vector<std::uint32_t>* changed, cpu::Workers& workers,
                         const BrickLoops& loops) {
  const bool all = changed == nullptr || grid_.x != field.grid().x || grid_.y != field.grid().y ||
                   grid_.z != field.grid().z;
  if (!all && changed->empty()) return;
  if (all) {
    resize(field.grid());
    mixed_.assign(field.bricks().cells(), 0);
  }
  Stale stale{std::vector<std::uint8_t>(field.bricks().cells(), all ? kWhole : 0),
              std::vector<std::uint8_t>(slots_.size(), all ? 1 : 0)};
  if (!all) find_stale(field, *changed, stale);

  bool moved = all;
  const std::vector<std::size_t> bricks = give_slots(field, stale, moved);
  fill_all(field, look, stale, workers, loops);
  std::vector<std::uint8_t> others(bricks.size());
  workers.run(static_cast<int>(bricks.size()), [&](int i) {
    const std::size_t at = i;
    others[at] = stale.touched[bricks[at]] != 0 && find_ranges(bricks[at], loops) ? 1 : 0;
  });
  if (!moved && std::find(others.begin(), others.end(), 1) == others.end()) return;
  find_distances();
  find_box();
  find_shell();
}

// Finds what is stale. With the pre-filter, a cell of the field changes the levels of the cells around it.
void FieldBricks::find_stale(const DensityField& field, const std::vector<std::uint32_t>& changed,
                             Stale& stale) const {
  const state::Grid& grid = field.bricks();
  std::vector<BrickPart> parts(grid.cells());
  const auto spread = [&](std::uint32_t brick, const BrickPart& part, int reach) {
    for_reached(grid, place_in(grid, brick), part, reach, [&](const state::Grid& near, const BrickPart& in) {
      parts[grid.index(near.x, near.y, near.z)].add(in);
    });
  };
  for (const std::uint32_t brick : changed) {
    spread(brick, field.refreshed_part(brick).matter, 1);
    spread(brick, field.refreshed_part(brick).heat, 0);
  }
  for (std::size_t brick = 0; brick < stale.source.size(); ++brick) {
    const BrickPart& part = parts[brick];
    if (!part.any()) continue;
    stale.source[brick] = 1;
    const auto next = [](std::uint8_t planes) { return (planes & kLastPlanes) != 0 ? 1 : 0; };
    for_near(bricks_, place_in(grid, brick), {next(part.x), next(part.y), next(part.z)},
             [&](const state::Grid& b) { stale.touched[bricks_.index(b.x, b.y, b.z)] = 1; });
  }
}

// Gives slots to touched bricks. A brick of nothing but air needs no slot. A new one is filled whole.
std::vector<std::size_t> FieldBricks::give_slots(const DensityField& field, Stale& stale, bool& moved) {
  const state::Grid& grid = field.bricks();
  std::vector<std::size_t> bricks;
  for (std::size_t brick = 0; brick < stale.touched.size(); ++brick) {
    if (stale.touched[brick] == 0) continue;
    const state::Grid at = place_in(bricks_, brick);
    std::int32_t& slot = slots_[brick];
    if (!anything_near(field, at)) {
      if (slot == 0) continue;
      moved = clear(brick) || moved;
      give_back(slot);
      continue;
    }
    if (slot == 0) {
      slot = take();
      const std::ptrdiff_t first = slot * kPlaces;
      std::fill_n(levels_.begin() + first, kPlaces, picture::kAir);
      std::fill_n(matter_.begin() + first, kPlaces, 0);
      for_near(grid, at, -1, 0,
               [&](const state::Grid& b) { stale.source[grid.index(b.x, b.y, b.z)] = kWhole; });
    }
    bricks.push_back(brick);
  }
  return bricks;
}

void FieldBricks::fill_all(const DensityField& field, const picture::Look& look, Stale& stale,
                           cpu::Workers& workers, const BrickLoops& loops) {
  const bool heated = look.glow || look.tinted();
  const auto heats = heated ? heats_of(look) : std::array<std::uint8_t, 257>{};
  const MatterSource matter{field.solid().data(),
                            field.liquid().data(),
                            heated ? field.heat().data() : nullptr,
                            field.has_obstacles() ? field.obstacle().data() : nullptr,
                            look.tinted() ? field.solid().data() : field.liquid().data(),
                            heats.data()};
  std::vector<std::size_t> sources;
  for (std::size_t brick = 0; brick < stale.source.size(); ++brick)
    if (stale.source[brick] != 0) sources.push_back(brick);
  std::vector<std::uint8_t> filled(sources.size());
  workers.run(static_cast<int>(sources.size()), [&](int i) {
    const std::size_t at = i;
    filled[at] = fill(field, matter, sources[at], stale.source[sources[at]] == kWhole, loops) ? 1 : 0;
  });
  std::fill(stale.touched.begin(), stale.touched.end(), 0);
  for (std::size_t i = 0; i < sources.size(); ++i)
    if (filled[i] != 0)
      for_near(bricks_, place_in(field.bricks(), sources[i]), 0, 1,
               [&](const state::Grid& b) { stale.touched[bricks_.index(b.x, b.y, b.z)] = 1; });
}

std::int32_t FieldBricks::take() {
  if (free_.empty()) {
    free_.push_back(static_cast<std::int32_t>(matter_.size() / kPlaces));
    levels_.resize(levels_.size() + kPlaces, picture::kAir);
    matter_.resize(matter_.size() + kPlaces, 0);
  }
  const std::int32_t slot = free_.back();
  free_.pop_back();
  return slot;
}

void FieldBricks::give_back(std::int32_t& slot) {
  if (slot != 0) free_.push_back(slot);
  slot = 0;
}

// Tells whether there is any intensity that the levels of the brick depend on.
bool FieldBricks::anything_near(const DensityField& field, const state::Grid& brick) const {
  const auto from = [](int b) { return std::max(b * kBrickSide - kLatticeBorder - 2, 0); };
  const auto end = [](int b, int side) { return std::min(b * kBrickSide + kBrickSide + 1, side); };
  for (int z = end(brick.z, grid_.z) - 1; z >= from(brick.z); --z)
    for (int y = from(brick.y); y < end(brick.y, grid_.y); ++y) {
      const std::uint16_t* row = field.intensity().data() + grid_.index(0, y, z);
      // A row has 13 cells, or fewer at the ends of the grid. Groups of four may overlap.
      const int first = from(brick.x), last = end(brick.x, grid_.x) - 4;
      std::uint64_t any = 0, group;
      for (int x = first; x < last; x += 4) {
        std::memcpy(&group, row + x, sizeof group);
        any |= group;
      }
      if (last >= first) {
        std::memcpy(&group, row + last, sizeof group);
        any |= group;
      } else {
        for (int x = first; x < last + 4; ++x) any |= row[x];
      }
      if (any != 0) return true;
    }
  return false;
}

// Empties a brick. Tells whether any of its blocks was occupied.
bool FieldBricks::clear(std::size_t brick) {
  bool moved = false;
  for (int b = 0; b < 8; ++b) {
    const std::size_t block = block_of(brick, b);
    moved = moved || occupied_[block] != 0;
    occupied_[block] = 0;
    if (records_[block] >= 0) records_[block] = kAirBlock;
  }
  return moved;
}

// Fills the cells of a brick of the field into all the bricks of the lattice that hold some of them. Tells
// whether any may have changed. `whole` says that some of those bricks are new.
bool FieldBricks::fill(const DensityField& field, const MatterSource& matter, std::size_t brick, bool whole,
                       const BrickLoops& loops) {
  const state::Grid at = place_in(field.bricks(), brick);
  BrickTargets to{};
  bool any = false;
  for (int b = 0; b < 8; ++b) {
    const state::Grid next{at.x + (b & 1), at.y + ((b >> 1) & 1), at.z + (b >> 2)};
    if (!bricks_.contains(next.x, next.y, next.z)) continue;
    const std::size_t slot = slots_[bricks_.index(next.x, next.y, next.z)];
    if (slot == 0) continue;
    any = true;
    to.levels[b] = levels_.data() + slot * kPlaces;
    to.matter[b] = matter_.data() + slot * kPlaces;
  }
  if (!any) {
    mixed_[brick] = 0;
    return false;
  }
  BrickCells cells;
  const bool had_matter = mixed_[brick] != 0;
  const bool has_matter = loops.cells(field.intensity().data(), matter, source_of(grid_, at), cells);
  mixed_[brick] = has_matter ? 1 : 0;
  // The first brick of the lattice holds all of the cells, and the others hold the same.
  if (!whole && to.levels[0] != nullptr && loops.same(cells, to)) return false;
  loops.scatter(cells, to, has_matter || had_matter);
  return true;
}

// Finds the ranges of levels. Tells whether other blocks are occupied now.
bool FieldBricks::find_ranges(std::size_t brick, const BrickLoops& loops) {
  BlockRanges ranges;
  loops.ranges(levels_.data() + slots_[brick] * kPlaces, ranges);
  bool moved = false;
  for (int b = 0; b < 8; ++b) {
    const std::size_t i = b;
    const std::size_t block = block_of(brick, b);
    const std::uint8_t occupied = ranges.most[i] >= 0 ? 1 : 0;
    moved = moved || occupied != occupied_[block];
    occupied_[block] = occupied;
    if (occupied != 0)
      records_[block] =
          slots_[brick] << 8 | slope_bound(ranges.along_x[i], ranges.along_y[i], ranges.along_z[i]);
    else if (records_[block] >= 0)
      records_[block] = kAirBlock;
  }
  return moved;
}

std::size_t FieldBricks::block_of(std::size_t brick, int which) const {
  const state::Grid at = place_in(bricks_, brick);
  return blocks_.index(2 * at.x + (which & 1), 2 * at.y + ((which >> 1) & 1), 2 * at.z + (which >> 2));
}

void FieldBricks::find_distances() {
  const std::vector<std::uint8_t> distances = block_distances(occupied_, blocks_, kFarthest);
  for (std::size_t i = 0; i < distances.size(); ++i)
    if (records_[i] < 0) records_[i] = kAirBlock | distances[i];
}

void FieldBricks::find_box() {
  int low[3] = {blocks_.x, blocks_.y, blocks_.z}, high[3] = {0, 0, 0};
  const std::size_t row = blocks_.x;
  for (int z = 0; z < blocks_.z; ++z)
    for (int y = 0; y < blocks_.y; ++y) {
      if (std::memchr(occupied_.data() + blocks_.index(0, y, z), 1, row) == nullptr) continue;
      for (int x = 0; x < blocks_.x; ++x) {
        if (occupied_[blocks_.index(x, y, z)] == 0) continue;
        const int at[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], at[axis] + 1);
        }
      }
    }
  // Outside of the box of samples there is air. The lattice reaches a cell further, and rays' ranges reach
  // less than that.
  const picture::Vector least = picture::field_low(), most = picture::field_high(cells_);
  box_ = {low_of_block(low[0], low[1], low[2]), low_of_block(high[0], high[1], high[2])};
  box_.low = {std::max(box_.low.x, least.x), std::max(box_.low.y, least.y), std::max(box_.low.z, least.z)};
  box_.high = {std::min(box_.high.x, most.x), std::min(box_.high.y, most.y), std::min(box_.high.z, most.z)};
}

// Finds the bricks that are not surrounded. A brick is surrounded if the six beside it are full of occupied
// blocks.
void FieldBricks::find_shell() {
  shell_.clear();
  const auto at = [](int i) { return static_cast<std::size_t>(i); };
  const std::size_t row = at(blocks_.x), slice = row * at(blocks_.y);
  const auto found = [&](std::size_t brick) {  // eight blocks as bits
    const state::Grid b = place_in(bricks_, brick);
    const std::uint8_t* first = occupied_.data() + blocks_.index(2 * b.x, 2 * b.y, 2 * b.z);
    unsigned bits = 0;
    for (unsigned i = 0; i < 8; ++i)
      bits |= unsigned{first[(i & 1) + ((i >> 1) & 1) * row + (i >> 2) * slice]} << i;
    return bits;
  };
  std::vector<std::uint8_t> blocks(bricks_.cells());
  for (std::size_t i = 0; i < blocks.size(); ++i)
    blocks[i] = slots_[i] == 0 ? 0 : static_cast<std::uint8_t>(found(i));
  for (int z = 0; z < bricks_.z; ++z)
    for (int y = 0; y < bricks_.y; ++y)
      for (int x = 0; x < bricks_.x; ++x) {
        const std::size_t i = bricks_.index(x, y, z);
        if (blocks[i] == 0) continue;
        const auto full = [&](int dx, int dy, int dz) {
          return bricks_.contains(x + dx, y + dy, z + dz) &&
                 blocks[bricks_.index(x + dx, y + dy, z + dz)] == 0xFF;
        };
        if (full(-1, 0, 0) && full(1, 0, 0) && full(0, -1, 0) && full(0, 1, 0) && full(0, 0, -1) &&
            full(0, 0, 1))
          continue;
        BlockBox box{{INT32_MAX, INT32_MAX, INT32_MAX}, {0, 0, 0}};
        for (int b = 0; b < 8; ++b) {
          if ((blocks[i] >> b & 1) == 0) continue;
          const int block[3] = {2 * x + (b & 1), 2 * y + ((b >> 1) & 1), 2 * z + (b >> 2)};
          for (int axis = 0; axis < 3; ++axis) {
            box.low[axis] = std::min(box.low[axis], block[axis]);
            box.high[axis] = std::max(box.high[axis], block[axis] + 1);
          }
        }
        shell_.push_back(box);
      }
}

std::size_t FieldBricks::bytes() const {
  return slots_.size() * 4 + levels_.size() * 2 + matter_.size() * 4 + records_.size() * 4;
}

}  // namespace voxmelt::render
