#include "render/packet/field_bricks.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "render/packet/block_distances.h"
#include "render/rule/matter.h"

namespace voxmelt::render {
namespace {

constexpr std::size_t kPlaces = kBrickVolume;
constexpr std::size_t kBeyond = 2;  // a pair of levels is read as 32 bits
static_assert(kPlacesOfBrick == kBrickPlaces);

// The cell of a brick's first place.
state::Grid first_cell(const state::Grid& brick) {
  constexpr int kBefore = kLatticeBorder + 1;
  return {brick.x * kBrickSide - kBefore, brick.y * kBrickSide - kBefore, brick.z * kBrickSide - kBefore};
}

BrickSource source_of(const state::Grid& grid, const state::Grid& brick) {
  const state::Grid first = first_cell(brick);
  BrickSource of;
  for (int i = 0; i < BrickSource::kWide; ++i) {
    of.rows[static_cast<std::size_t>(i)] = grid.index(0, std::clamp(first.y + i - 1, 0, grid.y - 1), 0);
    of.slices[static_cast<std::size_t>(i)] = grid.index(0, 0, std::clamp(first.z + i - 1, 0, grid.z - 1));
  }
  of.x = first.x;
  of.cells_x = grid.x;
  const auto low = [](int at) { return std::max(-at, 0); };
  const auto high = [](int at, int side) { return std::clamp(side - at, 0, kBrickPlaces); };
  of.low = {low(first.x), low(first.y), low(first.z)};
  of.high = {high(first.x, grid.x), high(first.y, grid.y), high(first.z, grid.z)};
  return of;
}

// The glow's heat by temperature, in 256 steps.
std::array<std::uint8_t, 257> heats_of(const picture::Look& look) {
  std::array<std::uint8_t, 257> of;
  for (std::size_t i = 0; i < of.size(); ++i)
    of[i] = static_cast<std::uint8_t>(picture::matter_of(0, 256, static_cast<std::int32_t>(i), 0, look).heat);
  return of;
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
  skip_.assign(blocks_.cells() + kBeyond, kFarthest);
  occupied_.assign(blocks_.cells(), 0);
}

void FieldBricks::update(const DensityField& field, const picture::Look& look,
                         const std::vector<std::uint32_t>* changed, cpu::Workers& workers,
                         const BrickLoops& loops) {
  const bool all = changed == nullptr || grid_.x != field.grid().x || grid_.y != field.grid().y ||
                   grid_.z != field.grid().z;
  if (all) resize(field.grid());
  std::vector<std::uint32_t> bricks;
  if (all) {
    for (std::size_t brick = 0; brick < slots_.size(); ++brick) bricks.push_back(static_cast<std::uint32_t>(brick));
  } else {
    // A brick of the field reaches, with the pre-filter, into those of the lattice around it.
    std::vector<std::uint8_t> touched(slots_.size(), 0);
    const state::Grid& of = field.bricks();
    for (const std::uint32_t brick : *changed) {
      const int x = static_cast<int>(brick % static_cast<std::uint32_t>(of.x)),
                y = static_cast<int>(brick / static_cast<std::uint32_t>(of.x) % static_cast<std::uint32_t>(of.y)),
                z = static_cast<int>(brick / static_cast<std::uint32_t>(of.x) / static_cast<std::uint32_t>(of.y));
      for (int k = std::max(z - 1, 0); k <= std::min(z + 1, bricks_.z - 1); ++k)
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, bricks_.y - 1); ++j)
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, bricks_.x - 1); ++i) touched[bricks_.index(i, j, k)] = 1;
    }
    for (std::size_t brick = 0; brick < touched.size(); ++brick)
      if (touched[brick] != 0) bricks.push_back(static_cast<std::uint32_t>(brick));
  }
  if (bricks.empty()) return;

  // What is nothing but air needs no slot.
  std::vector<std::uint8_t> needed(bricks.size()), moved(bricks.size());
  workers.run(static_cast<int>(bricks.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    needed[at] = anything_near(field, bricks[at], loops) ? 1 : 0;
  });
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    std::int32_t& slot = slots_[bricks[i]];
    if (needed[i] == 0) {
      if (slot != 0) moved[i] = clear(bricks[i]) ? 1 : 0;
      give_back(slot);
    } else if (slot == 0) {
      slot = take();
    }
  }
  const auto heats = look.glow ? heats_of(look) : std::array<std::uint8_t, 257>{};
  const MatterSource matter{field.solid().data(), field.liquid().data(), look.glow ? field.heat().data() : nullptr,
                            field.has_obstacles() ? field.obstacle().data() : nullptr, heats.data()};
  workers.run(static_cast<int>(bricks.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (needed[at] != 0) moved[at] = fill(field, matter, bricks[at], loops) ? 1 : 0;
  });
  if (!all && std::find(moved.begin(), moved.end(), 1) == moved.end()) return;
  find_distances();
  find_box();
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

state::Grid FieldBricks::place_of(std::size_t brick) const {
  const auto x = static_cast<std::size_t>(bricks_.x), y = static_cast<std::size_t>(bricks_.y);
  return {static_cast<int>(brick % x), static_cast<int>(brick / x % y), static_cast<int>(brick / x / y)};
}

// Is there any intensity that the levels of the brick depend on? They lie in two bricks of the field along each axis,
// and in the next one's first plane, which the range of the one before covers.
bool FieldBricks::anything_near(const DensityField& field, std::size_t brick, const BrickLoops& loops) const {
  const state::Grid at = place_of(brick);
  const state::Grid& of = field.bricks();
  std::uint16_t high = 0;
  for (int z = at.z - 1; z <= at.z; ++z)
    for (int y = at.y - 1; y <= at.y; ++y)
      for (int x = at.x - 1; x <= at.x; ++x)
        if (of.contains(x, y, z)) high = std::max(high, field.ranges()[of.index(x, y, z)].high);
  return high != 0 && loops.any(field.intensity().data(), source_of(grid_, at));
}

// Tells whether any of its blocks was occupied.
bool FieldBricks::clear(std::size_t brick) {
  bool moved = false;
  for (int b = 0; b < 8; ++b) {
    const std::size_t block = block_of(brick, b);
    moved = moved || occupied_[block] != 0;
    occupied_[block] = 0;
    skip_[block] &= 0xFF;
  }
  return moved;
}

// Tells whether other blocks are occupied now.
bool FieldBricks::fill(const DensityField& field, const MatterSource& matter, std::size_t brick, const BrickLoops& loops) {
  const BrickSource source = source_of(grid_, place_of(brick));
  const std::size_t slot = static_cast<std::size_t>(slots_[brick]) * kPlaces;
  BrickPlaces places;
  loops.places(field.intensity().data(), source, places);
  loops.levels(places, levels_.data() + slot);
  loops.matter(matter, source, places, matter_.data() + slot);
  BlockRanges ranges;
  loops.ranges(places, ranges);
  bool moved = false;
  for (int b = 0; b < 8; ++b) {
    const auto i = static_cast<std::size_t>(b);
    const std::size_t block = block_of(brick, b);
    const std::uint8_t occupied = ranges.most[i] >= -picture::kAir ? 1 : 0;
    moved = moved || occupied != occupied_[block];
    occupied_[block] = occupied;
    const int slope = slope_bound(ranges.along_x[i], ranges.along_y[i], ranges.along_z[i]);
    skip_[block] = static_cast<std::uint16_t>((skip_[block] & 0xFF) | slope << 8);
  }
  return moved;
}

std::size_t FieldBricks::block_of(std::size_t brick, int which) const {
  const state::Grid at = place_of(brick);
  return blocks_.index(2 * at.x + (which & 1), 2 * at.y + ((which >> 1) & 1), 2 * at.z + (which >> 2));
}

void FieldBricks::find_distances() {
  const std::vector<std::uint8_t> distances = block_distances(occupied_, blocks_, kFarthest);
  for (std::size_t i = 0; i < distances.size(); ++i)
    skip_[i] = static_cast<std::uint16_t>((skip_[i] & 0xFF00) | distances[i]);
}

void FieldBricks::find_box() {
  int low[3] = {blocks_.x, blocks_.y, blocks_.z}, high[3] = {0, 0, 0};
  const auto row = static_cast<std::size_t>(blocks_.x);
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
  const auto corner = [](const int(&block)[3]) {
    const auto axis = [](int b) {
      return (std::int64_t{b} * kBlockSide - kLatticeBorder) * picture::kCell - picture::kToPlace;
    };
    return picture::Vector{axis(block[0]), axis(block[1]), axis(block[2])};
  };
  box_ = {corner(low), corner(high)};
}

std::size_t FieldBricks::bytes() const {
  return slots_.size() * 4 + levels_.size() * 2 + matter_.size() * 4 + skip_.size() * 2;
}

}  // namespace voxmelt::render
