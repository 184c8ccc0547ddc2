// The apply stage lets flow what the patterns say (paper's law). All that a cell gives depends on itself
// alone. It is computed twice: when the cell comes, for its southern neighbours, and when it leaves the plane
// memory, for all others. In between the cell waits as it came, beside the sums of what has arrived from the
// south.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/paper_flow.h"
#include "hwmodel/pipeline/model/paper_window.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

enum Footing : int { on_liquid, on_solid, on_floor };

// Sums what arrives in a cell: amount, energy (before friction in the reading `text`), and amount x heat.
struct Arrivals {
  UInt<16> amount, energy;
  UInt<32> content;
};

struct Flowing : StoredCell {
  UInt<8> pattern;
  Arrivals in;  // in the plane memory: arrivals from the south

  // The following lie in registers and, for lane P - 1, in the memories beside the plane memory.
  std::array<PaperFlow::Gift, 4> axis;  // gifts of the cell; all the same unless there is a table
  PaperFlow::Gift diagonal;
  UInt<16> left_amount, left_energy;  // kept by the cell
  UInt<2> footing;
};

template <class Faults>
class Apply final : public Stage {
 public:
  explicit Apply(const Design& design, Faults faults = {})
      : Stage(StageKind::apply, design, window_lag(design.shape)),
        faults_(faults),
        law_(design.parameters.flow.paper),
        flow_(design.parameters.flow),
        alpha_{law_.alpha_liquid, law_.alpha_solid, law_.alpha_floor},
        printed_(law_.reading == rule::EnergyReading::printed),
        hot_(design.hot()),
        south_bits_(bits_for(southern_arrivals())),
        arrival_bits_(flow_.arrival_bits()),
        plane_(design.shape.plane()),
        column_(design.shape.column()),
        border_(design.shape.lanes),
        line_(design.shape.lanes, lag()) {}

  std::vector<BufferCost> buffers() const override {
    const bool one_ground = alpha_[0] == alpha_[1] && alpha_[1] == alpha_[2];
    const int cell = design().cell_bits(), directions = flow_.eight() ? 8 : 4;
    const int flow = flow_.flow_bits(), diagonal = flow_.eight() ? 2 * (flow - 2) : 0;
    const int south_sums = 2 * south_bits_ + (hot_ ? bits_for(southern_arrivals() * kHeatMax) : 0);
    const int waiting = cell + directions + south_sums;
    // One number each holds the sum of what a cell keeps and what has arrived. The energy that arrives is
    // still apart.
    const int before_east = cell + (hot_ ? 32 : 0) + (flow_.eight() ? 2 : 1) + 2 * flow +
                            (printed_ ? diagonal : (one_ground ? 0 : 2) + arrival_bits_);
    return window_buffers(shape(), {waiting + diagonal, waiting, before_east, cell});
  }
  // Counts the gifts of a cell, at both ends of the plane memory, and the finish of a cell.
  Units units() const override {
    const int directions = law_.use_table ? 4 : 1, kinds = directions + (flow_.eight() ? 1 : 0);
    const int shares = 2 * directions + (design().parameters.flow.thermal_viscosity ? 1 : 0);
    return {2 * (shares + (printed_ ? kinds : 0) + (hot_ ? kinds : 0)) + (printed_ ? 0 : 1) + (hot_ ? 2 : 0),
            hot_ ? 1 : 0, 0};
  }

 protected:
  void begin_step() override { dithers_.next(dither_of(step())); }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    Flowing* now = line_.tap(0);
    if (in != nullptr) take(in, now);
    const bool ends = ends_last_pass();
    Flowing* south = came().z > 0 || ends ? line_.tap(plane_) : nullptr;
    if (south != nullptr)
      for (const int lane : each_lane(shape().plane())) {
        wire(south[lane].in.amount, south_bits_);
        wire(south[lane].in.energy, south_bits_);
        weigh(south[lane], line_.tap(plane_ + 1)[lane].state);
      }

    Flowing* north = ends ? border_.data() : now;  // neighbours of the plane that leaves
    Flowing* west = came().has_west() ? (ends ? north : line_.tap(column_)) + lanes() - 1 : nullptr;
    Flowing* south_west =
        west != nullptr && south != nullptr ? line_.tap(plane_ + column_) + lanes() - 1 : nullptr;
    if (south != nullptr)
      for (const int lane : each_lane(ends ? shape().plane() : 0)) {
        meet(north[lane], west, south[lane], south_west);
        west = north + lane;
        south_west = south + lane;
      }
    dither_ = at(dithers_, shape().plane());
    // Nothing more can reach these cells. So the memory that follows holds plain cells again.
    for (int lane = 0; south != nullptr && lane + 1 < lanes(); ++lane) {
      compute_at(shape().plane(), lane);
      finish(south[lane]);
    }
    if (out == nullptr) return;
    Flowing* left = line_.tap(line_.delay());
    dither_ = at(dithers_, lag());
    compute_at(lag(), lanes() - 1);
    finish(left[lanes() - 1]);
    for (int lane = 0; lane < lanes(); ++lane) {
      Cell cell;
      cell.stored() = left[lane].stored();
      cell.settle_state();
      out[lane] = cell;
    }
  }

 private:
  friend Faults;

  using Gift = PaperFlow::Gift;

  // Returns the most that a cell may get from its southern neighbours.
  std::int64_t southern_arrivals() const { return flow_.eight() ? kOne + 2 * (kOne >> 2) : 2 * kOne; }

  std::int64_t rubbed(std::int64_t energy, std::int64_t footing) const {
    return scale(energy, looked_up(alpha_, footing));
  }

  void take(const Cell* in, Flowing* now) {
    const Flowing* below = line_.tap(1);
    for (const int lane : each_lane()) {
      Flowing& word = now[lane];
      word.stored() = in[lane].stored();
      word.pattern = in[lane].pattern;
      weigh(word, below[lane].state);
    }
  }

  // Computes all that the cell will give, and what it keeps.
  void weigh(Flowing& word, State below) const {
    if (came().y == 0) below = State::inert;
    word.footing = below == State::inert ? on_floor : below == State::solid ? on_solid : on_liquid;
    word.left_amount = word.amount;
    word.left_energy = word.energy;
    if (word.pattern == 0) return;
    std::int64_t amount = 0, energy = 0;
    const auto give = [&](const Gift& gift, int times) {
      amount += times * gift.amount;
      energy += times * (printed_ ? rubbed(gift.energy, word.footing) : std::int64_t{gift.energy});
    };
    if (law_.use_table) {
      const auto gifts = flow_.gifts(word.amount, word.energy, word.heat, word.pattern);
      for (std::size_t way = 0; way < 4; ++way) give(word.axis[way] = gifts[way], 1);
    } else {
      const auto pattern = static_cast<unsigned>(word.pattern);
      const Gift gift = flow_.gift(word.amount, word.energy, flow_.share(word.heat));
      word.axis.fill(gift);
      word.diagonal = gift.quartered();
      give(gift, std::popcount(pattern & 15u));
      give(word.diagonal, std::popcount(pattern >> 4));
    }
    word.left_amount = word.amount - amount;
    word.left_energy = word.energy - energy;
  }

  // Treats the pairs of the window but {cell, west}, which comes out of the plane memory as {south,
  // south-west}.
  void meet(Flowing& cell, Flowing* west, Flowing& south, Flowing* south_west) {
    if ((cell.pattern | south.pattern) != 0) {
      pass(cell, Way::south, south);
      pass(south, Way::north, cell);
    }
    if (south_west == nullptr) return;
    if ((south.pattern | south_west->pattern) != 0) {
      pass(south, Way::west, *south_west);
      pass(*south_west, Way::east, south);
    }
    if ((cell.pattern | south_west->pattern) >= 1 << kFirstDiagonal) {
      pass(cell, Way::south_west, *south_west);
      pass(*south_west, Way::north_east, cell);
    }
    if ((west->pattern | south.pattern) >= 1 << kFirstDiagonal) {
      pass(*west, Way::south_east, south);
      pass(south, Way::north_west, *west);
    }
  }

  void pass(const Flowing& giver, Way way, Flowing& to) {
    if ((giver.pattern >> way & 1) == 0) return;
    const bool diagonal = way >= kFirstDiagonal;
    Gift gift = diagonal ? giver.diagonal : giver.axis[way];
    faults_.gift(*this, giver, diagonal, to, gift);
    to.in.amount = to.in.amount + gift.amount;
    to.in.energy = to.in.energy + (printed_ ? rubbed(gift.energy, giver.footing) : std::int64_t{gift.energy});
    if (hot_) to.in.content = to.in.content + gift.amount * giver.heat;
  }

  // Returns how much of the arrived energy the cell gains, by the friction of its ground (reading `text`).
  std::int64_t rubbed_at_end(const Flowing& word, std::int64_t footing) const {
    return scale(word.in.energy, looked_up(alpha_, footing), dither_);
  }

  // Finishes a cell that has got all that it will get.
  void finish(Flowing& word) {
    if (word.blocked()) return;
    wire(word.in.energy, arrival_bits_);
    const UInt<16> amount = word.left_amount + word.in.amount;
    const std::int64_t gained = printed_ ? std::int64_t{word.in.energy} : rubbed_at_end(word, word.footing);
    std::int64_t energy = std::min<std::int64_t>(word.left_energy + gained, amount);
    faults_.finished(*this, word, amount, energy);
    if (hot_ && word.in.amount > 0)
      word.heat = mix(UInt<32>(word.left_amount * word.heat + word.in.content), amount, dither_);
    word.amount = amount;
    word.energy = energy;
  }

  [[no_unique_address]] Faults faults_;
  const rule::PaperLaw& law_;
  PaperFlow flow_;
  std::array<std::int64_t, 3> alpha_;  // index: Footing
  bool printed_, hot_;
  int south_bits_, arrival_bits_;
  std::size_t plane_, column_;
  OfTwoPasses<UInt<16>> dithers_;
  UInt<16> dither_;  // dither of the cells that are finished
  std::vector<Flowing> border_;
  TapLine<Flowing> line_;
};

}  // namespace voxmelt::hwmodel
