#include "render/density/slice_writer.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::render {
namespace {

using rule::kOne;

constexpr std::int32_t kSink = kOne * 4 / 10;  // how far the surface sinks into dry ground beside matter
constexpr std::int32_t kDive = kOne;           // ... and one cell further out
constexpr int kGroup = 8;                      // cells whose bits are a byte
static_assert(kGroup == kBrickSide);

std::uint16_t intensity_of(std::int32_t amount) {
  return static_cast<std::uint16_t>(std::clamp(amount, 0, kOne) * kFull / kOne);
}

// All ones in the lanes whose bit is set.
using Lanes = std::array<std::uint16_t, kGroup>;
constexpr auto kLanesOfBits = [] {
  std::array<Lanes, 256> table{};
  for (std::size_t bits = 0; bits < table.size(); ++bits)
    for (std::size_t lane = 0; lane < kGroup; ++lane)
      table[bits][lane] = (bits >> lane & 1) != 0 ? 0xffff : 0;
  return table;
}();

}  // namespace

SliceWriter::SliceWriter(const state::Volume& volume, const Columns& columns, CellFields& fields)
    : volume_(volume),
      columns_(columns),
      fields_(fields),
      stride_((static_cast<std::size_t>(volume.grid.x) + kGroup - 1) / kGroup * kGroup),
      values_(kChannels * stride_ * static_cast<std::size_t>(volume.grid.y), 0),
      row_in_use_(static_cast<std::size_t>(volume.grid.y), 0) {}

std::uint16_t* SliceWriter::row(int channel, int y) {
  row_in_use_[static_cast<std::size_t>(y)] |= flag_of(channel);
  return values_.data() +
         (static_cast<std::size_t>(channel) * row_in_use_.size() + static_cast<std::size_t>(y)) * stride_;
}

void SliceWriter::write(int z, BrickFlags& changed) {
  z_ = z;
  for (int y = 0; y < volume_.grid.y; ++y) write_matter(y);
  for (int x = 0; x < volume_.grid.x; ++x) {
    if (columns_.top[columns_.at(x, z)] > columns_.bed[columns_.at(x, z)]) write_obstacles(x);
    fill_ground(x);
  }
  for (int y = 0; y < volume_.grid.y; ++y) take_over(y, changed);
}

void SliceWriter::write_matter(int y) {
  const auto solid = volume_.solid.row(y, z_), liquid = volume_.liquid.row(y, z_);
  for (std::size_t w = 0; w < solid.size(); ++w)
    for (std::size_t byte = 0; byte < 8; ++byte) {
      const std::size_t solids = solid[w] >> 8 * byte & 0xff, liquids = liquid[w] >> 8 * byte & 0xff;
      if ((solids | liquids) == 0) continue;
      const std::size_t first = 64 * w + 8 * byte;
      const std::uint16_t* amount = volume_.amount.row(y, z_) + first;
      std::uint16_t *all = row(kIntensity, y) + first, *hard = row(kSolid, y) + first,
                    *soft = row(kLiquid, y) + first;
      for (std::size_t lane = 0; lane < kGroup; ++lane) {
        // The same as intensity_of, without leaving 16 bits: (255 a) >> 4.
        const auto a = std::min<std::uint16_t>(amount[lane], kOne);
        const auto value = static_cast<std::uint16_t>((a << 4) - ((a + 15) >> 4));
        hard[lane] = value & kLanesOfBits[solids][lane];
        soft[lane] = value & kLanesOfBits[liquids][lane];
        all[lane] = hard[lane] | soft[lane];
      }
      if (liquids == 0) continue;
      const std::uint16_t* temperature = volume_.heat.row(y, z_) + first;
      std::uint16_t* heat = row(kHeat, y) + first;
      for (std::size_t lane = 0; lane < kGroup; ++lane)
        heat[lane] = static_cast<std::uint16_t>(std::uint32_t{soft[lane]} * temperature[lane] /
                                                std::uint32_t{rule::kTemperatureMax});
    }
}

void SliceWriter::write_obstacles(int x) {
  const std::size_t c = columns_.at(x, z_);
  for (int y = columns_.bed[c]; y < columns_.top[c]; ++y)
    if (volume_.inert.test(x, y, z_))
      intensity(x, y) = row(kObstacle, y)[x] = static_cast<std::uint16_t>(kFull);
}

void SliceWriter::fill_ground(int x) {
  const std::size_t c = columns_.at(x, z_);
  const int bed = columns_.bed[c], ny = volume_.grid.y;
  if (const int floor = puddle_floor(volume_, columns_, x, z_); floor > bed)
    shift_liquid(x, floor, columns_.shift[c]);
  if (bed == 0) return;
  const int distance = columns_.distance[c];
  if (distance > kGroundReach) return;
  const std::int32_t sink = distance < kGroundReach ? kSink - kSink * columns_.wet[c] / kOne : kDive;
  std::int32_t rise = columns_.offset[c] - sink;
  if (bed < ny && volume_.inert.test(x, bed, z_))
    rise = std::max(rise, 0);  // an obstacle stands on it without a gap

  // Ground up to the true height of the bed, less the sink: full but for the last two cells.
  int y = 0;
  for (; y < bed - 2; ++y) intensity(x, y) = static_cast<std::uint16_t>(kFull);
  for (; y <= std::min(bed, ny - 1); ++y) {
    const std::int32_t ground = std::clamp((bed - y) * kOne + rise, 0, kOne);
    intensity(x, y) = std::max(intensity(x, y), intensity_of(ground));
  }
  if (bed < ny && volume_.liquid.test(x, bed, z_)) shift_liquid(x, bed, rise + columns_.shift[c]);
}

// The liquid that rests on the bed is moved up or down by the part of a cell by which the bed lies above or
// below its cell's top face; otherwise the terraces of the voxelised ground show through its surface.
void SliceWriter::shift_liquid(int x, int bed, std::int32_t rise) {
  const int ny = volume_.grid.y;
  int top = bed;
  while (top < ny && volume_.liquid.test(x, top, z_)) ++top;
  const auto amount_at = [&](int y) {
    return y < bed ? kOne : (y < top ? matter_amount(volume_, x, y, z_) : std::int32_t{0});
  };
  const std::int32_t shift = std::clamp(rise, -kOne, kOne);
  const int first = shift < 0 ? bed - 1 : bed;
  for (int y = first; y <= std::min(top, ny - 1); ++y) {
    if (y == top && intensity(x, y) != 0) break;  // something else rests on the liquid
    const std::int32_t other = shift < 0 ? amount_at(y + 1) : amount_at(y - 1);
    const std::int32_t part = std::abs(shift);
    intensity(x, y) = intensity_of((amount_at(y) * (kOne - part) + other * part) / kOne);
  }
}

void SliceWriter::take_over(int y, BrickFlags& changed) {
  const state::Grid& grid = fields_.grid;
  const std::size_t line = static_cast<std::size_t>(z_) * row_in_use_.size() + static_cast<std::size_t>(y);
  const std::uint8_t in_use = row_in_use_[static_cast<std::size_t>(y)], written = fields_.written_[line];
  if ((in_use | written) == 0) return;  // nothing here, now as before

  // Groups of eight are compared as one vector.
  const auto take = [&](std::uint16_t * old, const std::uint16_t* fresh, std::size_t bytes,
                        std::uint8_t& flags, int channel) __attribute__((always_inline)) {
    if (std::memcmp(fresh, old, bytes) == 0) return;
    std::memcpy(old, fresh, bytes);
    flags |= flag_of(channel);
  };
  const auto kept = fields_.all();
  for (int channel = 0; channel < kChannels; ++channel) {
    if (((in_use | written) & flag_of(channel)) == 0) continue;
    std::uint16_t* fresh = row(channel, y);
    std::uint16_t* old = kept[static_cast<std::size_t>(channel)]->data() + grid.index(0, y, z_);
    std::uint8_t* flags = changed.data() + fields_.bricks.index(0, y / kBrickSide, z_ / kBrickSide);
    int x = 0;
    for (; x + kBrickSide <= grid.x; x += kBrickSide)
      take(old + x, fresh + x, 2 * kBrickSide, *flags++, channel);
    if (x < grid.x) take(old + x, fresh + x, 2 * static_cast<std::size_t>(grid.x - x), *flags, channel);
    std::fill_n(fresh, stride_, std::uint16_t{0});
  }
  fields_.written_[line] = in_use;
  row_in_use_[static_cast<std::size_t>(y)] = 0;
}

}  // namespace voxmelt::render
