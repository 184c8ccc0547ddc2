#include "render/density/brick_writer.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

#include "kernel/automaton/rule/fixed_point.h"
#include "render/density/loops.h"

namespace voxmelt::render {
namespace {

using rule::kOne;

std::uint16_t intensity_of(std::int32_t amount) {
  return static_cast<std::uint16_t>(std::clamp(amount, 0, kOne) * kFull / kOne);
}

// Returns the value that all cells of the box have, or kMixed.
std::int32_t one_value(const state::Grid& grid, const CellBox& box, const Values<std::uint16_t>& values) {
  const std::uint16_t first = values[grid.index(box.low.x, box.low.y, box.low.z)];
  bool same = true;
  for_rows(grid, box, [&](std::size_t at, const state::Grid&, int cells) {
    if (!same) return;
    unsigned differs = 0;
    for (int x = 0; x < cells; ++x) differs |= (values.data()[at + x] ^ first);
    same = differs == 0;
  });
  return same ? first : CellFields::kMixed;
}

}  // namespace

void BrickWriter::write_matter(const state::Grid& brick) {
  const state::Grid& grid = fields_.grid;
  const std::size_t index = fields_.bricks.index(brick.x, brick.y, brick.z);
  const CellBox box = cells_of(grid, brick);
  const auto word = static_cast<std::size_t>(brick.x) / 8;
  const state::Layout& layout = volume_.amount.layout();
  const std::size_t cell = layout.at(box.low.x, box.low.y, box.low.z).offset,
                    to = grid.index(box.low.x, box.low.y, box.low.z);
  const auto kept = [&](Values<std::uint16_t>& values) {
    return Block<std::uint16_t>{values.data() + to, grid.index(0, 1, 0), grid.index(0, 0, 1)};
  };
  const auto field = [&](const state::Field<std::uint16_t>& values) {
    return Block<const std::uint16_t>{values.data() + cell, layout.row(), layout.slice()};
  };
  const Block<const std::uint8_t> materials{
      volume_.material.empty() ? nullptr : volume_.material.data() + cell, layout.row(), layout.slice()};
  const std::size_t words = volume_.solid.row_words();
  const MatterBrick from{box.high.x - box.low.x,
                         box.high.y - box.low.y,
                         box.high.z - box.low.z,
                         volume_.solid.row(box.low.y, box.low.z).data() + word,
                         volume_.liquid.row(box.low.y, box.low.z).data() + word,
                         words,
                         words * grid.y,
                         brick.x % 8 * kBrickSide,
                         field(volume_.amount),
                         field(volume_.heat),
                         materials,
                         kept(fields_.solid),
                         kept(fields_.liquid),
                         kept(fields_.heat),
                         fields_.uniform(kSolid, index) != 0,
                         fields_.uniform(kLiquid, index) != 0,
                         fields_.uniform(kHeat, index) != 0,
                         fields_.wanted_.heat,
                         fields_.wanted_.tones ? fields_.wanted_.tones->data() : nullptr};
  const MatterFound found = loops_.matter(from);

  BrickChange& change = fields_.changes_[index];
  const auto note = [&](Channel channel, const BrickPart& part, BrickPart& in) {
    if (!part.any()) return;
    change.channels |= flag_of(channel);
    fields_.uniform_[channel][index] = one_value(grid, box, *fields_.all()[channel]);
    in.add(part);
  };
  note(kSolid, found.solid, change.matter);
  note(kLiquid, found.liquid, change.matter);
  note(kHeat, found.heat, change.heat);
}

std::uint64_t BrickWriter::take_inert(const state::Grid& brick) {
  const CellBox box = cells_of(fields_.grid, brick);
  const auto word = static_cast<std::size_t>(brick.x) / 8;
  std::uint64_t differs = 0;
  for (int z = box.low.z; z < box.high.z; ++z)
    for (int y = box.low.y; y < box.high.y; ++y) {
      const std::uint64_t now = volume_.inert.row(y, z)[word];
      std::uint64_t& kept = fields_.inert_.row(y, z)[word];
      if (now == kept) continue;
      differs |= now ^ kept;
      kept = now;
    }
  return differs;
}

unsigned BrickWriter::inert_bits(int y, int z) const {
  return static_cast<unsigned>(volume_.inert.row(y, z)[static_cast<std::size_t>(box_.low.x) / 64] >>
                               box_.low.x % 64) &
         0xff;
}

void BrickWriter::write_intensity(const state::Grid& brick) {
  box_ = cells_of(fields_.grid, brick);
  const Columns& columns = fields_.columns_;
  const std::size_t column = columns.brick_at(brick.x, brick.z);
  const std::size_t index = fields_.bricks.index(brick.x, brick.y, brick.z);
  put_matter();
  const bool obstacles = columns.has_obstacles(column) && put_obstacles(brick);
  if (!fields_.obstacle.empty()) {
    if (!obstacles) obstacle_.fill(0);
    if (obstacles || fields_.uniform(kObstacle, index) != 0) take_over(kObstacle, obstacle_, index);
  }
  const Extent& planned = columns.planned(column);
  if (planned.low < box_.high.y && planned.high > box_.low.y)
    for (int z = box_.low.z; z < box_.high.z; ++z)
      for (int x = box_.low.x; x < box_.high.x; ++x) {
        const Plan& plan = columns.plan(columns.at(x, z));
        if (plan.low() < box_.high.y && plan.high() > box_.low.y) put_plan(plan, x, z);
      }
  take_over(kIntensity, intensity_, index);
}

void BrickWriter::put_matter() {
  for_rows(fields_.grid, box_, [&](std::size_t i, const state::Grid&, int) {  // rows lie far apart in memory
    __builtin_prefetch(fields_.solid.data() + i);
    __builtin_prefetch(fields_.liquid.data() + i);
    __builtin_prefetch(fields_.intensity.data() + i);
  });
  intensity_.fill(0);
  for_rows(fields_.grid, box_, [&](std::size_t i, const state::Grid& cell, int cells) {
    std::uint16_t* to = &at(intensity_, cell.x, cell.y, cell.z);
    const std::uint16_t *solid = fields_.solid.data() + i, *liquid = fields_.liquid.data() + i;
    if (cells == kBrickSide)
      for (int x = 0; x < kBrickSide; ++x) to[x] = solid[x] | liquid[x];
    else
      for (int x = 0; x < cells; ++x) to[x] = solid[x] | liquid[x];
  });
}

// Returns false if there are none.
bool BrickWriter::put_obstacles(const state::Grid& brick) {
  obstacle_.fill(0);
  bool any = false;
  for (int z = box_.low.z; z < box_.high.z; ++z)
    for (int y = box_.low.y; y < box_.high.y; ++y) {
      const unsigned inert = inert_bits(y, z);
      for (int x = box_.low.x; inert != 0 && x < box_.high.x; ++x) {
        if ((inert >> (x - brick.x * kBrickSide) & 1) == 0 ||
            y < fields_.columns_.stand(fields_.columns_.at(x, z)).bed)
          continue;
        at(obstacle_, x, y, z) = at(intensity_, x, y, z) = static_cast<std::uint16_t>(kFull);
        any = true;
      }
    }
  return any;
}

void BrickWriter::put_plan(const Plan& plan, int x, int z) {
  if (plan.puddle() && plan.floor > plan.bed) move_puddle(plan, x, z);
  if (plan.rise != Plan::kNoGround) fill_ground(plan, x, z);
  if (plan.puddle() && plan.floor == plan.bed) move_puddle(plan, x, z);
}

// Fills the ground up to the true height of the bed, less the sink.
void BrickWriter::fill_ground(const Plan& plan, int x, int z) {
  for (int y = box_.low.y; y < std::min(plan.bed + 1, box_.high.y); ++y) {
    std::uint16_t& to = at(intensity_, x, y, z);
    to = plan.bed - y > 2 ? static_cast<std::uint16_t>(kFull)
                          : std::max(to, intensity_of((plan.bed - y) * kOne + plan.rise));
  }
}

void BrickWriter::move_puddle(const Plan& plan, int x, int z) {
  const std::uint16_t* const amounts = volume_.amount.data() + volume_.at(x, 0, z).offset;
  const std::size_t step = volume_.amount.layout().row();
  const auto amount_at = [&](int y) -> std::int32_t {
    if (y < plan.floor || y >= plan.end) return y < plan.floor ? kOne : 0;
    return std::min<std::int32_t>(amounts[y * step], kOne);
  };
  const std::int32_t part = std::abs(plan.shift);
  const int first = plan.shift < 0 ? plan.floor - 1 : plan.floor;
  for (int y = std::max(first, box_.low.y); y <= std::min(plan.end, box_.high.y - 1); ++y) {
    std::uint16_t& to = at(intensity_, x, y, z);
    if (y == plan.end && to != 0) return;  // something else rests on the liquid
    const std::int32_t other = plan.shift < 0 ? amount_at(y + 1) : amount_at(y - 1);
    to = intensity_of((amount_at(y) * (kOne - part) + other * part) >> 12);
  }
}

void BrickWriter::take_over(int channel, Cells& fresh, std::size_t brick) {
  const std::size_t c = channel;
  std::uint16_t* const kept = fields_.all()[c]->data();
  BrickPart part;
  std::array<std::uint16_t, kBrickSide> differs{};
  for_rows(fields_.grid, box_, [&](std::size_t i, const state::Grid& cell, int cells) {
    const std::uint16_t* row = &at(fresh, cell.x, cell.y, cell.z);
    if (cells == kBrickSide ? std::memcmp(row, kept + i, sizeof(std::uint16_t) * kBrickSide) == 0
                            : std::memcmp(row, kept + i, sizeof(std::uint16_t) * cells) == 0)
      return;
    for (int x = 0; x < cells; ++x) {
      std::uint16_t& old = kept[i + x];
      auto& differ = differs[x];
      differ = static_cast<std::uint16_t>(differ | (old ^ row[x]));
      old = row[x];
    }
    part.y = static_cast<std::uint8_t>(part.y | 1 << (cell.y - box_.low.y));
    part.z = static_cast<std::uint8_t>(part.z | 1 << (cell.z - box_.low.z));
  });
  if (part.y == 0) return;
  for (int x = 0; x < kBrickSide; ++x)
    part.x = static_cast<std::uint8_t>(part.x | (differs[x] != 0 ? 1 << x : 0));
  fields_.uniform_[c][brick] = one_value(fields_.grid, box_, *fields_.all()[c]);
  fields_.changes_[brick].channels |= flag_of(channel);
  fields_.changes_[brick].matter.add(part);
}

}  // namespace voxmelt::render
