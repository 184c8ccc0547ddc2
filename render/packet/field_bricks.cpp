#include "render/packet/field_bricks.h"

#include <algorithm>
#include <array>
#include <cstdlib>

#include "render/rule/matter.h"

namespace voxmelt::render {
namespace {

constexpr int kWide = kBrickPlaces + 2;  // with the neighbours that the pre-filter reads
constexpr std::size_t kPlaces = kBrickVolume;
constexpr std::size_t kBeyond = 2;  // a pair of levels is read as 32 bits

// The cell of a brick's first place.
state::Grid first_cell(const state::Grid& brick) {
  constexpr int kBefore = kLatticeBorder + 1;
  return {brick.x * kBrickSide - kBefore, brick.y * kBrickSide - kBefore, brick.z * kBrickSide - kBefore};
}

// The levels of a brick's places.
void brick_levels(const DensityField& field, const state::Grid& first, std::int16_t* to) {
  const state::Grid& grid = field.grid();
  std::array<std::uint16_t, kWide * kWide * kBrickPlaces> along_x;
  std::array<std::uint16_t, kWide * kBrickPlaces * kBrickPlaces> along_y;
  for (int k = 0; k < kWide; ++k)
    for (int j = 0; j < kWide; ++j) {
      const std::uint16_t* row =
          field.intensity().data() + grid.index(0, std::clamp(first.y + j - 1, 0, grid.y - 1),
                                                std::clamp(first.z + k - 1, 0, grid.z - 1));
      std::array<std::uint32_t, kWide> cells;
      if (first.x >= 1 && first.x + kBrickPlaces < grid.x) {
        for (int i = 0; i < kWide; ++i) cells[static_cast<std::size_t>(i)] = row[first.x - 1 + i];
      } else {
        for (int i = 0; i < kWide; ++i)
          cells[static_cast<std::size_t>(i)] = row[std::clamp(first.x + i - 1, 0, grid.x - 1)];
      }
      std::uint16_t* out = along_x.data() + (k * kWide + j) * kBrickPlaces;
      for (std::size_t i = 0; i < kBrickPlaces; ++i)
        out[i] =
            static_cast<std::uint16_t>((43 * cells[i] + 170 * cells[i + 1] + 43 * cells[i + 2] + 128) >> 8);
    }

  const auto filtered = [](std::uint16_t a, std::uint16_t b, std::uint16_t c) {
    return static_cast<std::uint16_t>((43u * a + 170u * b + 43u * c + 128u) >> 8);
  };
  constexpr int kRow = kBrickPlaces, kSlice = kBrickPlaces * kBrickPlaces;
  for (int k = 0; k < kWide; ++k) {
    const std::uint16_t* from = along_x.data() + k * kWide * kRow;
    std::uint16_t* out = along_y.data() + k * kSlice;
    for (int i = 0; i < kSlice; ++i) out[i] = filtered(from[i], from[i + kRow], from[i + 2 * kRow]);
  }
  for (int i = 0; i < kSlice * kBrickPlaces; ++i)
    to[i] = static_cast<std::int16_t>(filtered(along_y[static_cast<std::size_t>(i)],
                                               along_y[static_cast<std::size_t>(i + kSlice)],
                                               along_y[static_cast<std::size_t>(i + 2 * kSlice)]) +
                                      picture::kAir);

  // Outside the grid there is air.
  const auto inside = [](int place, int side) { return place >= 0 && place < side; };
  if (first.x < 0 || first.y < 0 || first.z < 0 || first.x + kRow > grid.x || first.y + kRow > grid.y ||
      first.z + kRow > grid.z)
    for (int k = 0; k < kRow; ++k)
      for (int j = 0; j < kRow; ++j)
        for (int i = 0; i < kRow; ++i)
          if (!inside(first.x + i, grid.x) || !inside(first.y + j, grid.y) || !inside(first.z + k, grid.z))
            to[k * kSlice + j * kRow + i] = picture::kAir;
}

void brick_matter(const DensityField& field, const picture::Look& look, const state::Grid& first,
                  const std::int16_t* levels, std::uint32_t* to) {
  const state::Grid& grid = field.grid();
  const std::uint16_t* obstacles = field.has_obstacles() ? field.obstacle().data() : nullptr;
  for (int k = 0; k < kBrickPlaces; ++k)
    for (int j = 0; j < kBrickPlaces; ++j)
      for (int i = 0; i < kBrickPlaces; ++i, ++levels, ++to) {
        *to = 0;
        if (*levels == picture::kAir) continue;  // so inside the grid
        const std::size_t c = grid.index(first.x + i, first.y + j, first.z + k);
        const picture::Matter of = picture::matter_of(field.solid()[c], field.liquid()[c], field.heat()[c],
                                                      obstacles != nullptr ? obstacles[c] : 0, look);
        *to = static_cast<std::uint32_t>(of.liquid | of.heat << 8 | of.obstacle << 16);
      }
}

// Of a block of a brick: its largest level, and its slope's bound.
struct BlockRange {
  int most, slope;
};
BlockRange block_range(const std::int16_t* levels, int bx, int by, int bz) {
  constexpr int kRow = kBrickPlaces, kSlice = kBrickPlaces * kBrickPlaces;
  const std::int16_t* const corner = levels + kSlice + kRow + 1 + kBlockSide * (bz * kSlice + by * kRow + bx);
  int most = picture::kAir, along_x = 0, along_y = 0, along_z = 0;
  for (int k = 0; k <= kBlockSide; ++k)
    for (int j = 0; j <= kBlockSide; ++j)
      for (int i = 0; i <= kBlockSide; ++i) {
        const std::int16_t* at = corner + k * kSlice + j * kRow + i;
        most = std::max<int>(most, *at);
        if (i < kBlockSide) along_x = std::max(along_x, std::abs(at[1] - *at));
        if (j < kBlockSide) along_y = std::max(along_y, std::abs(at[kRow] - *at));
        if (k < kBlockSide) along_z = std::max(along_z, std::abs(at[kSlice] - *at));
      }
  return {most, FieldBricks::slope_bound(along_x, along_y, along_z)};
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
                         const std::vector<std::uint32_t>* changed, cpu::Workers& workers) {
  const bool all = changed == nullptr || grid_.x != field.grid().x || grid_.y != field.grid().y ||
                   grid_.z != field.grid().z;
  if (all) resize(field.grid());
  std::vector<std::uint32_t> bricks;
  if (all) {
    for (std::size_t brick = 0; brick < slots_.size(); ++brick)
      bricks.push_back(static_cast<std::uint32_t>(brick));
  } else {
    // A brick of the lattice reads, with the pre-filter, the cells 8 b - 4 .. 8 b + 8.
    std::vector<std::uint8_t> touched(slots_.size(), 0);
    const state::Grid& of = field.bricks();
    for (const std::uint32_t brick : *changed) {
      const int x = static_cast<int>(brick % static_cast<std::uint32_t>(of.x)),
                y = static_cast<int>(brick / static_cast<std::uint32_t>(of.x) %
                                     static_cast<std::uint32_t>(of.y)),
                z = static_cast<int>(brick / static_cast<std::uint32_t>(of.x) /
                                     static_cast<std::uint32_t>(of.y));
      for (int k = std::max(z - 1, 0); k <= std::min(z + 1, bricks_.z - 1); ++k)
        for (int j = std::max(y - 1, 0); j <= std::min(y + 1, bricks_.y - 1); ++j)
          for (int i = std::max(x - 1, 0); i <= std::min(x + 1, bricks_.x - 1); ++i)
            touched[bricks_.index(i, j, k)] = 1;
    }
    for (std::size_t brick = 0; brick < touched.size(); ++brick)
      if (touched[brick] != 0) bricks.push_back(static_cast<std::uint32_t>(brick));
  }
  if (bricks.empty()) return;

  // What is nothing but air needs no slot.
  std::vector<std::uint8_t> needed(bricks.size());
  workers.run(static_cast<int>(bricks.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    needed[at] = anything_near(field, bricks[at]) ? 1 : 0;
  });
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    std::int32_t& slot = slots_[bricks[i]];
    if (needed[i] == 0) {
      give_back(slot);
      clear(bricks[i]);
    } else if (slot == 0) {
      slot = take();
    }
  }
  workers.run(static_cast<int>(bricks.size()), [&](int i) {
    const auto at = static_cast<std::size_t>(i);
    if (needed[at] != 0) fill(field, look, bricks[at]);
  });
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

// Is there any intensity that the levels of the brick depend on?
bool FieldBricks::anything_near(const DensityField& field, std::size_t brick) const {
  const state::Grid first = first_cell(place_of(brick));
  const auto from = [](int at) { return std::max(at - 1, 0); };
  const auto end = [](int at, int side) { return std::min(at + kBrickPlaces + 1, side); };
  for (int z = from(first.z); z < end(first.z, grid_.z); ++z)
    for (int y = from(first.y); y < end(first.y, grid_.y); ++y) {
      const std::uint16_t* row = field.intensity().data() + grid_.index(0, y, z);
      std::uint32_t any = 0;
      for (int x = from(first.x); x < end(first.x, grid_.x); ++x) any |= row[x];
      if (any != 0) return true;
    }
  return false;
}

void FieldBricks::clear(std::size_t brick) {
  for (int b = 0; b < 8; ++b) {
    const std::size_t block = block_of(brick, b);
    occupied_[block] = 0;
    skip_[block] = 0;
  }
}

void FieldBricks::fill(const DensityField& field, const picture::Look& look, std::size_t brick) {
  const state::Grid first = first_cell(place_of(brick));
  const std::size_t slot = static_cast<std::size_t>(slots_[brick]) * kPlaces;
  brick_levels(field, first, levels_.data() + slot);
  for (int b = 0; b < 8; ++b) {
    const BlockRange range = block_range(levels_.data() + slot, b & 1, (b >> 1) & 1, b >> 2);
    const std::size_t block = block_of(brick, b);
    occupied_[block] = range.most >= 0 ? 1 : 0;
    skip_[block] = static_cast<std::uint16_t>(range.slope << 8);
  }
  brick_matter(field, look, first, levels_.data() + slot, matter_.data() + slot);
}

std::size_t FieldBricks::block_of(std::size_t brick, int which) const {
  const state::Grid at = place_of(brick);
  return blocks_.index(2 * at.x + (which & 1), 2 * at.y + ((which >> 1) & 1), 2 * at.z + (which >> 2));
}

// The distance in blocks, by largest component: as often as a block is still dark when what is occupied grows
// by one block in every direction.
void FieldBricks::find_distances() {
  const auto x = static_cast<std::size_t>(blocks_.x), row = x,
             slice = x * static_cast<std::size_t>(blocks_.y);
  std::vector<std::uint8_t> grown = occupied_, next(grown.size()), distance(grown.size());
  const auto widen = [&](std::size_t stride, int side) {
    for (std::size_t i = 0; i < grown.size(); i += stride * static_cast<std::size_t>(side)) {
      const std::uint8_t* from = grown.data() + i;
      std::uint8_t* to = next.data() + i;
      if (side == 1) {
        std::copy_n(from, stride, to);
        continue;
      }
      const std::size_t count = stride * static_cast<std::size_t>(side);
      for (std::size_t j = 0; j < stride; ++j) to[j] = from[j] | from[j + stride];
      for (std::size_t j = stride; j < count - stride; ++j)
        to[j] = from[j - stride] | from[j] | from[j + stride];
      for (std::size_t j = count - stride; j < count; ++j) to[j] = from[j - stride] | from[j];
    }
    grown.swap(next);
  };
  for (int d = 0; d < kFarthest; ++d) {
    for (std::size_t i = 0; i < grown.size(); ++i)
      distance[i] = static_cast<std::uint8_t>(distance[i] + (grown[i] ^ 1));
    if (d + 1 == kFarthest) break;
    widen(1, blocks_.x);
    widen(row, blocks_.y);
    widen(slice, blocks_.z);
  }
  for (std::size_t i = 0; i < distance.size(); ++i)
    skip_[i] = static_cast<std::uint16_t>((skip_[i] & 0xFF00) | distance[i]);
}

void FieldBricks::find_box() {
  int low[3] = {blocks_.x, blocks_.y, blocks_.z}, high[3] = {0, 0, 0};
  for (int z = 0; z < blocks_.z; ++z)
    for (int y = 0; y < blocks_.y; ++y)
      for (int x = 0; x < blocks_.x; ++x) {
        if (occupied_[blocks_.index(x, y, z)] == 0) continue;
        const int at[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], at[axis] + 1);
        }
      }
  const auto corner = [](const int(&block)[3]) {
    const auto axis = [](int b) {
      return (std::int64_t{b} * kBlockSide - kLatticeBorder) * picture::kCell - picture::kToPlace;
    };
    return picture::Vector{axis(block[0]), axis(block[1]), axis(block[2])};
  };
  // Rays look at a sample more on either side of the box, which must lie in the lattice.
  const picture::Vector least = corner(low), most = corner(high), first = picture::field_low(),
                        end = picture::field_high(cells_);
  box_ = {{std::max(least.x, first.x), std::max(least.y, first.y), std::max(least.z, first.z)},
          {std::min(most.x, end.x), std::min(most.y, end.y), std::min(most.z, end.z)}};
}

std::size_t FieldBricks::bytes() const {
  return slots_.size() * 4 + levels_.size() * 2 + matter_.size() * 4 + skip_.size() * 2;
}

}  // namespace voxmelt::render
