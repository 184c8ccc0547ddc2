// One sweep up each column computes gravity, under both laws, and the paper's excess. It treats a pair of
// cells a cycle. The lower cell of the pair is then complete and leaves. The loop from one cycle to the next
// runs through the upper cell: two comparisons, a product, and with heat a division (docs/automaton.md,
// section 8).
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

struct Falling : StoredCell {
  UInt<1> beside_wall, in_run, set;
};

template <class Faults>
class Gravity final : public Stage {
 public:
  // Hanging drops and set cells depend on what is above the upper cell. Only they need one token of
  // look-ahead.
  explicit Gravity(const Design& design, Faults faults = {})
      : Stage(StageKind::gravity, design, design.needs_ceilings() ? 2 : 1),
        faults_(faults),
        fall_(design.parameters.flow.fall),
        law_(design.parameters.flow.paper),
        paper_(design.paper()),
        hot_(design.hot()),
        line_(design.shape.lanes, lag()) {}

  // The paper's law spreads behind gravity: pattern must know which places are set.
  Wires side_bands() const override { return Wires().add(Wire::set, paper_ && design().freezes()); }
  std::vector<BufferCost> buffers() const override {
    const int bits = design().cell_bits() + (design().needs_walls() ? 1 : 0) + (paper_ ? 0 : 1);
    return {{"cell register", lag(), lanes(), bits}};
  }
  // A fall multiplies for its part and for the gained energy. A mixture takes three products and a division.
  Units units() const override {
    return {(fall_.factor < 65536 || fall_.wall_factor < 65536 ? 1 : 0) + (paper_ ? 1 : 0) + (hot_ ? 3 : 0),
            hot_ ? 1 : 0, 0};
  }

 protected:
  void begin_step() override { dithers_.next(dither_of(step())); }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    Falling* newest = line_.tap(0);
    if (in != nullptr)
      for (int lane = 0; lane < lanes(); ++lane) {
        const Cell& cell = in[lane];
        newest[lane] = {cell.stored(), cell.beside_wall, cell.in_run, cell.set};
      }
    if (out == nullptr) return;
    dither_ = at(dithers_, lag());

    Falling* low = line_.tap(line_.delay());
    Falling* high = line_.tap(line_.delay() - 1);
    const int height = shape().grid.y;
    const bool pair = leaving().y + 1 < height, below_top = leaving().y + 2 < height;
    for (const int lane : each_lane(lag())) {
      if (pair)
        move(low[lane], high[lane], !below_top || newest[lane].blocked());
      else
        faults_.column_ended(*this, low[lane], high[lane], newest[lane].blocked());
      out[lane] = leave(low[lane]);
    }
  }

 private:
  friend Faults;

  // `blocked_above` tells if the cell above the upper one is blocked. It matters only where drops hang and
  // cells are set.
  void move(Falling& low, Falling& high, bool blocked_above) {
    if (low.blocked() || high.blocked()) return;
    if (high.amount > 0 && low.amount < kOne && (paper_ || high.in_run == 0))
      fall(low, high, blocked_above);
    else if (paper_ && low.amount > kOne)
      push_up(low, high);
  }

  void fall(Falling& low, Falling& high, bool blocked_above) {
    const std::int64_t space = kOne - low.amount;
    std::int64_t flow = std::min(released(low, high, high.beside_wall > 0, blocked_above), space);
    faults_.released(*this, low, high, blocked_above, flow);
    if (flow == 0) return;

    if (paper_) {
      const std::int64_t moved = std::min<std::int64_t>(high.energy, flow);
      const std::int64_t room = low.amount + flow - low.energy;
      std::int64_t gained = std::min(UInt<35>(moved * law_.beta) >> 16, room);
      if (law_.reading == rule::EnergyReading::printed) gained = std::min<std::int64_t>(gained, high.energy);
      const std::int64_t lost = law_.reading == rule::EnergyReading::text ? moved : gained;
      low.energy = low.energy + gained;
      high.energy = std::min<std::int64_t>(high.energy - lost, high.amount - flow);
    }
    carry(high, low, flow);
    faults_.fell(*this, low);
  }

  // Returns what the upper cell gives.
  std::int64_t released(const Falling& low, const Falling& high, bool beside_wall, bool blocked_above) const {
    const bool hangs = high.amount < fall_.hang && low.amount == 0;
    if ((high.set > 0 || hangs) && (beside_wall || blocked_above)) return 0;
    const std::int64_t part = scale(high.amount, beside_wall ? fall_.wall_factor : fall_.factor);
    return std::min<std::int64_t>(high.amount, UInt<17>(part + fall_.minimum));
  }

  // Piles up what does not fit.
  void push_up(Falling& low, Falling& high) {
    const std::int64_t flow = std::min(low.amount - kOne, kAmountMax - high.amount);
    if (flow == 0) return;
    if (hot_) hold_in_register(13, static_cast<int>(lag()) - 1);  // its heat needs a division before the next
    const std::int64_t energy = std::min<std::int64_t>(low.energy, flow);
    low.energy = low.energy - energy;
    high.energy = high.energy + energy;
    carry(low, high, flow);
  }

  void carry(Falling& from, Falling& to, std::int64_t flow) {
    const UInt<16> after = to.amount + flow;
    if (hot_) to.heat = mix(UInt<32>(to.amount * to.heat + flow * from.heat), after, dither_);
    to.amount = after;
    from.amount = from.amount - flow;
  }

  Cell leave(const Falling& word) const {
    Cell cell;
    cell.stored() = word.stored();
    cell.settle_state();
    if (paper_) cell.set = word.set;
    return cell;
  }

  [[no_unique_address]] Faults faults_;
  const rule::Fall& fall_;
  const rule::PaperLaw& law_;
  bool paper_, hot_;
  OfTwoPasses<UInt<16>> dithers_;
  UInt<16> dither_;  // dither of the token that leaves
  TapLine<Falling> line_;
};

}  // namespace voxmelt::hwmodel
