// Gravity, both laws, and the paper's excess: one sweep up each column, a pair of cells a cycle. The lower
// cell of the pair is finished by it and leaves. The loop from one cycle to the next runs through the upper
// cell: two comparisons, a product, and with heat a division (docs/automaton.md, section 8).
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

struct Falling {
  UInt<16> amount = kFlatBed, energy, heat;
  State state = State::inert;
  UInt<1> beside_wall, in_run;
  bool blocked() const { return state == State::solid || state == State::inert; }
};

class Gravity final : public Stage {
 public:
  // Hanging drops depend on what is above the upper cell: only then one token of look-ahead.
  explicit Gravity(const Design& design)
      : Stage("gravity", "gravity", design, design.parameters.flow.fall.hang > 0 ? 2 : 1),
        fall_(design.parameters.flow.fall),
        law_(design.parameters.flow.paper),
        paper_(design.paper()),
        hot_(design.hot()),
        line_(design.shape.lanes, static_cast<std::size_t>(lag())) {}

  std::vector<BufferCost> buffers() const override {
    const int bits = design().cell_bits() + (design().needs_walls() ? 1 : 0) + (paper_ ? 0 : 1);
    return {{"cell register", lag(), lanes(), bits}};
  }
  Units units() const override {  // of a fall: its part, the gained energy; of a mixture: three products
    return {(fall_.factor < 65536 || fall_.wall_factor < 65536 ? 1 : 0) + (paper_ ? 1 : 0) + (hot_ ? 3 : 0),
            hot_ ? 1 : 0, 0};
  }

 protected:
  void begin_step() override { dither_ = dither_of(step()); }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    Falling* newest = line_.tap(0);
    if (in != nullptr)
      for (int lane = 0; lane < lanes(); ++lane) {
        const Cell& cell = in[lane];
        newest[lane] = {cell.amount, cell.energy, cell.heat, cell.state, cell.beside_wall, cell.in_run};
      }
    if (out == nullptr) return;

    Falling* low = line_.tap(line_.delay());
    Falling* high = line_.tap(line_.delay() - 1);
    const int height = shape().grid.y;
    const bool pair = leaving().y + 1 < height, below_top = leaving().y + 2 < height;
    for (int lane = 0; lane < lanes(); ++lane) {
      if (pair)
        move(low[lane], high[lane], !below_top || newest[lane].blocked(), lane);
      else if (armed(Fault::gravity_column_wrap)) [[unlikely]]
        wrap(low[lane], high[lane], newest[lane].blocked(), lane);
      out[lane] = leave(low[lane]);
    }
  }

 private:
  // `blocked_above`: is the cell above the upper one blocked? (Heeded only where drops hang.)
  void move(Falling& low, Falling& high, bool blocked_above, int lane) {
    if (low.blocked() || high.blocked()) return;
    if (high.amount > 0 && low.amount < kOne && (paper_ || high.in_run == 0))
      fall(low, high, blocked_above, lane);
    else if (paper_ && low.amount > kOne)
      push_up(low, high);
  }

  void fall(Falling& low, Falling& high, bool blocked_above, int lane) {
    const std::int64_t space = kOne - low.amount;
    const std::int64_t ready = released(low, high, high.beside_wall > 0, blocked_above);
    std::int64_t flow = std::min(ready, space);
    if (armed(Fault::gravity_wall_missed)) [[unlikely]] {
      const std::int64_t free = std::min(released(low, high, false, blocked_above), space);
      if (free != flow) flow = free, strike_low(lane);
    }
    if (armed(Fault::gravity_room) && ready > space && low.amount + ready <= kAmountMax) [[unlikely]]
      flow = ready, strike_low(lane);
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
    const std::int64_t old_heat = low.heat;
    carry(high, low, flow);
    if (armed(Fault::gravity_mix) && low.heat != old_heat) [[unlikely]]
      low.heat = old_heat, strike_low(lane);
    if (armed(Fault::gravity_one_more)) [[unlikely]]
      low.amount = low.amount + 1, strike_low(lane);
  }

  // What the upper cell lets go.
  std::int64_t released(const Falling& low, const Falling& high, bool beside_wall, bool blocked_above) const {
    if (high.amount < fall_.hang && low.amount == 0 && (beside_wall || blocked_above)) return 0;
    const std::int64_t part = scale(high.amount, beside_wall ? fall_.wall_factor : fall_.factor);
    return std::min<std::int64_t>(high.amount, UInt<17>(part + fall_.minimum));
  }

  // The piling of what does not fit.
  void push_up(Falling& low, Falling& high) {
    const std::int64_t flow = std::min(low.amount - kOne, kAmountMax - high.amount);
    if (flow == 0) return;
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

  static Cell leave(const Falling& word) {
    Cell cell;
    cell.amount = word.amount;
    cell.energy = word.energy;
    cell.heat = word.heat;
    cell.state = word.state;
    cell.settle_state();
    return cell;
  }

  void strike_low(int lane) { strike(leaving().x + lane, leaving().y, leaving().z); }

  // The fault of a height counter that wraps a cycle late: the pair reaches over the columns' ends.
  void wrap(Falling& low, Falling& high, bool blocked_above, int lane) {
    Falling wrong_low = low, wrong_high = high;
    move(wrong_low, wrong_high, blocked_above, lane);
    if (wrong_low.amount <= low.amount) return;
    low = wrong_low, high = wrong_high;
    strike_low(lane);
  }

  const rule::Fall& fall_;
  const rule::PaperLaw& law_;
  bool paper_, hot_;
  UInt<16> dither_;
  TapLine<Falling> line_;
};

}  // namespace

std::unique_ptr<Stage> make_gravity(const Design& design) { return std::make_unique<Gravity>(design); }

}  // namespace voxmelt::hwmodel
