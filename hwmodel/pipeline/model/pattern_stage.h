// The pattern stage chooses the directions that each cell gives to (paper's law). They lead to neighbours
// that are open and stand low enough, each with one chance in two. A giver's facts are two numbers, the least
// amounts of a neighbour that gets nothing. Behind the plane memory they are computed once more, which is
// cheaper than keeping them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/paper_flow.h"
#include "hwmodel/pipeline/model/paper_window.h"
#include "hwmodel/pipeline/model/random_block.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

struct Giver : StoredCell {
  UInt<8> pattern;  // directions, before the random byte takes some away
  // A neighbour that holds less than its limit is available. These are registers, and the first is no less.
  UInt<16> axis_limit, diagonal_limit;
  UInt<1> set;  // in the bits of the state
};

template <class Faults>
class Pattern final : public Stage {
 public:
  explicit Pattern(const Design& design, Faults faults = {})
      : Stage(StageKind::pattern, design, window_lag(design.shape)),
        faults_(faults),
        law_(design.parameters.flow.paper),
        flow_(design.parameters.flow),
        keys_(speck_keys(design.parameters.seed)),
        plane_(design.shape.plane()),
        column_(design.shape.column()),
        border_(design.shape.lanes),
        line_(design.shape.lanes, lag()) {}

  // A word has the directions decided so far: to the south, and in the east memory also to the north and
  // west.
  Wires side_bands() const override { return {Wire::pattern}; }
  int width_of(Wire wire) const override {
    return wire == Wire::pattern ? law_.neighbours : Stage::width_of(wire);
  }
  std::vector<BufferCost> buffers() const override {
    const int cell = design().cell_bits(), limit = bits_for(flow_.limit());
    if (!flow_.eight()) return window_buffers(shape(), {cell + 1, cell + 1, cell + 3 + limit, cell + 4});
    return window_buffers(shape(), {cell + 2 + limit, cell + 3, cell + 6 + 2 * limit, cell + 8});
  }
  Units units() const override {  // shares at both ends of the plane memory; a random block serves 8 lanes
    return {law_.use_table || !law_.downhill ? 0 : 2 * (design().parameters.flow.thermal_viscosity ? 2 : 1),
            0, 1};
  }

 protected:
  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    Giver* now = line_.tap(0);
    const bool above_floor = came().y > 0;
    if (in != nullptr) {
      const Giver* below = line_.tap(1);
      for (const int lane : each_lane()) {
        now[lane].stored() = in[lane].stored();
        now[lane].set = in[lane].set;
        find_limits(now[lane], above_floor && below[lane].state == State::air);
      }
    }
    const bool ends = ends_last_pass();
    Giver* south = came().z > 0 || ends ? line_.tap(plane_) : nullptr;
    if (south != nullptr) {
      const Giver* below = line_.tap(plane_ + 1);
      for (const int lane : each_lane(shape().plane()))
        find_limits(south[lane], above_floor && below[lane].state == State::air);
    }
    Giver* north = ends ? border_.data() : now;  // neighbours of the plane that leaves
    Giver* west = came().has_west() ? (ends ? north : line_.tap(column_)) + lanes() - 1 : nullptr;
    Giver* south_west =
        west != nullptr && south != nullptr ? line_.tap(plane_ + column_) + lanes() - 1 : nullptr;
    for (const int lane : each_lane(ends ? shape().plane() : 0)) {
      meet(north[lane], west, south, south_west);
      west = north + lane;
      if (south != nullptr) south_west = south++;
    }
    if (out != nullptr) leave(line_.tap(lag()), out);
  }

 private:
  friend Faults;

  // Finds the facts of a giver. Nothing is lower than a limit of 0.
  void find_limits(Giver& cell, bool air_below) const {
    cell.axis_limit = cell.diagonal_limit = 0;
    const bool stands = cell.state == State::liquid && !(law_.support && air_below);
    if (stands && cell.set == 0) allow(cell);
    faults_.allowed(*this, stands, cell);
  }

  void allow(Giver& cell) const {
    const bool energetic = cell.energy > law_.threshold;
    if (!energetic && law_.slump == 0) return;
    const std::int64_t limit = flow_.limit();
    if (!law_.downhill) {
      cell.axis_limit = cell.diagonal_limit = limit;
      return;
    }
    const std::int64_t margin = energetic ? law_.margin : law_.slump;
    const std::int64_t given = law_.use_table ? 0 : flow_.axis_flow(cell.amount, cell.heat);
    const auto below = [&](std::int64_t slope) {
      return std::clamp<std::int64_t>(cell.amount - std::max(given, slope), 0, limit);
    };
    cell.axis_limit = below(margin);
    cell.diagonal_limit = below(UInt<20>(9 * margin) >> 3);
  }

  // Treats the pairs of the window but {cell, west}, which comes out of the plane memory as {south,
  // south-west}.
  void meet(Giver& cell, Giver* west, Giver* south, Giver* south_west) {
    if (south == nullptr) return;
    if ((cell.axis_limit | south->axis_limit) != 0) {
      offer(cell, Way::south, *south, cell.axis_limit);
      offer(*south, Way::north, cell, south->axis_limit);
    }
    if (south_west == nullptr) return;
    if ((south->axis_limit | south_west->axis_limit) != 0) {
      offer(*south, Way::west, *south_west, south->axis_limit);
      offer(*south_west, Way::east, *south, south_west->axis_limit);
    }
    if (!flow_.eight()) return;
    if ((cell.axis_limit | south_west->axis_limit) != 0) {
      const bool open = !(west->blocked() && south->blocked());
      offer(cell, Way::south_west, *south_west, cell.diagonal_limit, open);
      offer(*south_west, Way::north_east, cell, south_west->diagonal_limit, open);
    }
    if ((west->axis_limit | south->axis_limit) != 0) {
      const bool open = !(cell.blocked() && south_west->blocked());
      offer(*west, Way::south_east, *south, west->diagonal_limit, open);
      offer(*south, Way::north_west, *west, south->diagonal_limit, open);
    }
  }

  void offer(Giver& giver, Way way, const Giver& other, std::int64_t limit, bool open = true) {
    if (other.blocked()) return;
    if (open && other.amount < limit) giver.pattern = giver.pattern | 1 << way;
    faults_.offered(*this, giver, way, other, limit, open);
  }

  // Draws a subset of the available directions. Every subset is equally likely.
  void leave(const Giver* words, Cell* out) {
    std::int64_t block_of = -1;
    std::uint64_t block = 0;
    for (const int lane : each_lane(lag())) {
      const Giver& word = words[lane];
      Cell cell;
      cell.stored() = word.stored();
      if (word.pattern != 0) {
        const int x = leaving().x + lane;
        if (x / 8 != block_of) {
          block_of = x / 8;
          block = speck_block(keys_, step_at(lag()), block_index(x));
        }
        cell.pattern = word.pattern & speck_byte(block, x);
      }
      faults_.drawn(*this, word, lane, cell);
      out[lane] = cell;
    }
  }

  // Returns the number of a block. Blocks are numbered along x, then y, then z, modulo 2^32.
  std::uint32_t block_index(std::uint32_t x) const {
    const std::uint32_t y = leaving().y, z = leaving().z, columns = shape().grid.x, rows = shape().grid.y;
    return (z * rows + y) * ((columns + 7) / 8) + x / 8;
  }

  [[no_unique_address]] Faults faults_;
  const rule::PaperLaw& law_;
  PaperFlow flow_;
  SpeckKeys keys_;
  std::size_t plane_, column_;
  std::vector<Giver> border_;
  TapLine<Giver> line_;
};

}  // namespace voxmelt::hwmodel
