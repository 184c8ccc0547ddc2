// What the patterns say flows (paper's law). A cell that comes knows its pattern, so all it will give is
// subtracted at once; what arrives is summed while it waits for its neighbours.
#include <bit>

#include "hwmodel/stream/paper_flow.h"
#include "hwmodel/stream/paper_window.h"
#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

using Gift = PaperFlow::Gift;
enum Ground : int { on_liquid, on_solid, on_floor };

struct Flowing {
  UInt<16> amount = kFlatBed;  // what is left, and what has arrived
  UInt<16> energy;             // the same; reading `text`: only what is left
  UInt<16> arrived;            // reading `text`: energy before friction; with 8 neighbours 15 bits
  UInt<16> heat;
  UInt<32> content;  // amount x heat
  State state = State::inert;
  UInt<2> ground;
  UInt<8> pattern;
  Gift north;  // to each axis direction
  Gift east;   // with a table; until the east neighbour comes

  SInt<18> suspect;  // only for a planted fault: energy that the wrong friction adds

  bool blocked() const { return state == State::solid || state == State::inert; }
};

class Apply final : public Stage {
 public:
  explicit Apply(const Design& design)
      : Stage("apply", "spread", design,
              window_lag(design.shape, design.parameters.flow.paper.neighbours == 8)),
        law_(design.parameters.flow.paper),
        flow_(design.parameters.flow),
        alpha_{law_.alpha_liquid, law_.alpha_solid, law_.alpha_floor},
        printed_(law_.reading == rule::EnergyReading::printed),
        hot_(design.hot()),
        arrival_bits_(flow_.arrival_bits()),
        plane_(static_cast<std::size_t>(design.shape.plane())),
        column_(static_cast<std::size_t>(design.shape.column())),
        line_(design.shape.lanes, static_cast<std::size_t>(lag())) {}

  std::vector<BufferCost> buffers() const override {
    const bool eight = flow_.eight(), one_ground = alpha_[0] == alpha_[1] && alpha_[1] == alpha_[2];
    const int gift = 2 * flow_.flow_bits(), sums = printed_ ? 32 : 32 + flow_.arrival_bits();
    const int waiting = 2 + (one_ground ? 0 : 2) + sums + (hot_ ? 48 : 0);  // content, and the heat it gives
    if (!eight)
      return window_buffers(shape(), false,
                            {waiting + gift + 2 + (law_.use_table ? gift : 0), waiting + gift + 1, 0, 0});
    return window_buffers(
        shape(), true,
        {waiting + gift + 5, waiting + gift + 3, waiting + gift - 4 + 1, design().cell_bits()});
  }
  Units units() const override {
    const int directions = law_.use_table ? 4 : 1, diagonals = flow_.eight() ? 2 : 1;
    const int shares = 2 * directions + (design().parameters.flow.thermal_viscosity ? 1 : 0);
    const int friction = printed_ ? directions + 2 * diagonals : 1;
    return {shares + friction + (hot_ ? 2 + 2 * diagonals : 0), hot_ ? 1 : 0, 0};
  }

 protected:
  void begin_step() override { dither_ = dither_of(step()); }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    Flowing* now = line_.tap(0);
    const Flowing* below = line_.tap(1);
    Flowing* south = came().z > 0 ? line_.tap(plane_) : nullptr;
    Flowing* west = came().x > 0 ? line_.tap(column_) + lanes() - 1 : nullptr;
    Flowing* south_west = west != nullptr && south != nullptr && flow_.eight()
                              ? line_.tap(plane_ + column_) + lanes() - 1
                              : nullptr;
    for (int lane = 0; lane < lanes(); ++lane) {
      Outlets outlets;
      if (in != nullptr) take(in[lane], came().y > 0 ? below[lane].state : State::inert, now[lane], outlets);
      meet(now[lane], outlets, west, south, south_west, came().x + lane);
      west = now + lane;
      if (south != nullptr) {
        if (flow_.eight()) south_west = south;
        ++south;
      }
    }
    // Cells that nothing more can reach: in the memory that follows they are plain cells again.
    const int finished = flow_.eight() ? lanes() - 1 : lanes();
    if (came().z > 0)
      for (int lane = 0; lane < finished; ++lane) finish(line_.tap(plane_)[lane], lane, came().z - 1, came());
    if (out == nullptr) return;
    Flowing* left = line_.tap(line_.delay());
    if (flow_.eight()) finish(left[lanes() - 1], lanes() - 1, leaving().z, leaving());
    for (int lane = 0; lane < lanes(); ++lane) {
      Cell cell;
      cell.amount = left[lane].amount;
      cell.energy = left[lane].energy;
      cell.heat = left[lane].heat;
      cell.state = left[lane].state;
      cell.settle_state();
      out[lane] = cell;
    }
  }

 private:
  struct Outlets {  // of the cell that comes, towards those already there
    Gift west, south;
  };

  std::int64_t rubbed(std::int64_t energy, std::int64_t ground) const {
    return scale(energy, alpha_[static_cast<std::size_t>(ground)]);
  }
  static int ground_on(State below) {
    return below == State::inert ? on_floor : below == State::solid ? on_solid : on_liquid;
  }

  void take(const Cell& cell, State below, Flowing& word, Outlets& outlets) const {
    word.amount = cell.amount;
    word.energy = cell.energy;
    word.heat = cell.heat;
    word.state = cell.state;
    if (word.blocked()) return;
    word.ground = ground_on(below);
    word.pattern = cell.pattern;
    if (cell.pattern != 0) give(cell, word, outlets);
    if (hot_) word.content = word.amount * word.heat;
  }

  // All that the cell will give leaves it.
  void give(const Cell& cell, Flowing& word, Outlets& outlets) const {
    std::int64_t amount = 0, energy = 0;
    const auto sum = [&](const Gift& gift, int times) {
      amount += times * gift.amount;
      energy += times * (printed_ ? rubbed(gift.energy, word.ground) : std::int64_t{gift.energy});
    };
    if (law_.use_table) {
      const auto gifts = flow_.gifts(cell.amount, cell.energy, cell.heat, cell.pattern);
      for (std::size_t way = 0; way < 4; ++way) sum(gifts[way], 1);
      word.east = gifts[Way::east], word.north = gifts[Way::north];
      outlets = {gifts[Way::west], gifts[Way::south]};
    } else {
      word.north = flow_.gift(cell.amount, cell.energy, flow_.share(cell.heat));
      const auto pattern = static_cast<unsigned>(cell.pattern);
      sum(word.north, std::popcount(pattern & 15u));
      sum(word.north.quartered(), std::popcount(pattern >> 4));
      outlets = {word.north, word.north};
    }
    word.amount = cell.amount - amount;
    word.energy = cell.energy - energy;
  }

  // Every pair whose last corner is the cell that comes, at x.
  void meet(Flowing& cell, const Outlets& outlets, Flowing* west, Flowing* south, Flowing* south_west,
            int x) {
    const int z = came().z;
    if (west != nullptr && (cell.pattern | west->pattern) != 0) {
      pass(cell, Way::west, outlets.west, *west, x - 1, z);
      pass(*west, Way::east, law_.use_table ? west->east : west->north, cell, x, z);
    }
    if (south != nullptr && (cell.pattern | south->pattern) != 0) {
      pass(cell, Way::south, outlets.south, *south, x, z - 1);
      pass(*south, Way::north, south->north, cell, x, z);
    }
    if (south_west == nullptr || west == nullptr) return;
    if ((cell.pattern | south_west->pattern) >= 1 << kFirstDiagonal) {
      pass(cell, Way::south_west, cell.north, *south_west, x - 1, z - 1);
      pass(*south_west, Way::north_east, south_west->north, cell, x, z);
    }
    if ((west->pattern | south->pattern) >= 1 << kFirstDiagonal) {
      pass(*west, Way::south_east, west->north, *south, x, z - 1);
      pass(*south, Way::north_west, south->north, *west, x - 1, z);
    }
  }

  void pass(const Flowing& giver, Way way, const Gift& axis, Flowing& to, int to_x, int to_z) {
    if ((giver.pattern >> way & 1) == 0) return;
    const bool diagonal = way >= kFirstDiagonal;
    Gift gift = diagonal ? axis.quartered() : axis;
    if (armed(Fault::apply_flow_lost) && gift.amount > 0) [[unlikely]]
      return strike(to_x, came().y, to_z);
    // All that may still come must have room above the wrong flow.
    if (armed(Fault::apply_diagonal_whole) && diagonal && gift.amount < axis.amount &&
        to.amount + axis.amount + 5 * kOne <= kAmountMax) [[unlikely]] {
      gift.amount = axis.amount;
      strike(to_x, came().y, to_z);
    }
    to.amount = to.amount + gift.amount;
    if (hot_) to.content = to.content + gift.amount * giver.heat;
    if (!printed_) {
      to.arrived = wire(to.arrived + gift.energy, arrival_bits_);
      return;
    }
    const std::int64_t energy = rubbed(gift.energy, giver.ground);
    to.energy = to.energy + energy;
    if (armed(Fault::apply_alpha) && to.suspect == 0) [[unlikely]]
      to.suspect = rubbed(gift.energy, wrong_ground(giver)) - energy;
  }

  static std::int64_t wrong_ground(const Flowing& word) { return (word.ground + 1) % 3; }

  // The word of a cell to which all has come; `at`: the place of its column and height.
  void finish(Flowing& word, int lane, int z, const Place& at) {
    if (word.blocked()) return;
    const auto settled = [&](std::int64_t ground) {
      const std::int64_t gained =
          printed_ ? 0 : scale(word.arrived, alpha_[static_cast<std::size_t>(ground)], dither_);
      return std::min<std::int64_t>(word.energy + gained, word.amount);
    };
    std::int64_t energy = settled(word.ground);
    if (armed(Fault::apply_alpha)) [[unlikely]] {
      const std::int64_t wrong = printed_
                                     ? std::clamp<std::int64_t>(word.energy + word.suspect, 0, word.amount)
                                     : settled(wrong_ground(word));
      if (wrong != energy) energy = wrong, strike(at.x + lane, at.y, z);
    }
    word.energy = energy;
    if (hot_ && word.amount > 0) word.heat = mix(word.content, word.amount, dither_);  // one part: as it was
  }

  const rule::PaperLaw& law_;
  PaperFlow flow_;
  std::array<std::int64_t, 3> alpha_;  // by Ground
  bool printed_, hot_;
  int arrival_bits_;
  std::size_t plane_, column_;
  UInt<16> dither_;
  TapLine<Flowing> line_;
};

}  // namespace

std::unique_ptr<Stage> make_apply(const Design& design) { return std::make_unique<Apply>(design); }

}  // namespace voxmelt::hwmodel
