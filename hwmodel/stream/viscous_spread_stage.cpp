// Phase `spread` of the viscous law (docs/automaton.md, section 11). When a cell q comes, the four pairs
// whose last cell (of the two and, for a diagonal, its two corners) it is are done: q with the cells W and S
// beside it, q with SW, and W with S. Each pair is computed once and booked at both cells, in the taps.
#include "hwmodel/stream/stages.h"
#include "hwmodel/stream/viscous_run.h"

namespace voxmelt::hwmodel {
namespace {

enum class Ground : std::uint8_t { solid, inert, free, run };  // `free`: outside runs

struct SpreadWord {
  Ground ground = Ground::inert;
  UInt<1> beside_wall;
  UInt<16> amount = kFlatBed, heat;  // as they came: what a pair looks at
  UInt<16> present;                  // amount after the pairs done so far
  UInt<32> content;                  // amount x heat after them
  SInt<30> head;
  UInt<14> mobility, exposed;
  UInt<25> dead;

  bool blocked() const { return ground == Ground::solid || ground == Ground::inert; }
  bool runs() const { return ground == Ground::run; }
};

// A cell in the window and where it lies; null outside of the grid.
struct Seen {
  SpreadWord* word;
  int x, z;
};

class ViscousSpread final : public Stage {
 public:
  explicit ViscousSpread(const Design& design)
      : Stage("spread", "spread", design, design.shape.plane() + design.shape.column()),
        hot_(design.hot()),
        walls_(design.needs_walls()),
        head_bits_(RunWidths(design).head),
        line_(lanes(), static_cast<std::size_t>(lag())) {}

  // Only the last lane of a token has a pair left (its diagonal to the next block) after one plane.
  std::vector<BufferCost> buffers() const override {
    const std::int64_t done = 2 + 16 + (hot_ ? 16 : 0) + (walls_ ? 1 : 0);
    const std::int64_t open = done + 16 + (hot_ ? 32 : 0) + head_bits_ + 14 + 14 + 25;
    const std::int64_t column = shape().column(), between = shape().plane() - column;
    std::vector<BufferCost> costs{{"column memory", column, lanes(), open}};
    if (between > 0) costs.push_back({"plane memory", between, lanes(), open});
    if (lanes() > 1) costs.push_back({"column memory, done", column, lanes() - 1, done});
    costs.push_back({"column memory, last lane", column, 1, open});
    return costs;
  }

  // Per pair: (g + mobility) A and c drop; with heat f h, and per cell A h and the mixture's rounding.
  Units units() const override { return {8 + (hot_ ? 4 + 2 : 0), hot_ ? 1 : 0, 0}; }

 protected:
  void begin_step() override {
    dither_ = dither_of(step());
    for (int axis = 0; axis < 4; ++axis)
      axis_dither_[static_cast<std::size_t>(axis)] = dither_of(step(), axis, 4);
  }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    SpreadWord* now = line_.tap(0);
    if (in != nullptr)
      for (int lane = 0; lane < lanes(); ++lane) now[lane] = taken(in[lane]);
    const auto column = static_cast<std::size_t>(shape().column());
    const auto plane = static_cast<std::size_t>(shape().plane());
    SpreadWord* south = line_.tap(plane);
    SpreadWord* last = line_.tap(plane + column);
    const int end = lanes() - 1;
    SpreadWord* west = came().x > 0 ? line_.tap(column) + end : nullptr;
    SpreadWord* south_west = came().x > 0 ? last + end : nullptr;
    const bool has_south = came().z > 0;
    for (int lane = 0; lane < lanes(); ++lane) {
      look(now + lane, west, has_south ? south + lane : nullptr, has_south ? south_west : nullptr,
           came().x + lane);
      west = now + lane;
      south_west = south + lane;
    }

    if (has_south)
      for (int lane = 0; lane < end; ++lane) finish(south[lane]);
    if (out == nullptr) return;
    finish(last[end]);
    for (int lane = 0; lane < lanes(); ++lane) give(last[lane], out[lane]);
  }

 private:
  SpreadWord taken(const Cell& cell) const {
    SpreadWord word;
    word.amount = cell.amount;
    if (hot_) word.heat = cell.heat;
    if (cell.blocked()) {
      word.ground = cell.state == State::solid ? Ground::solid : Ground::inert;
      return word;
    }
    word.ground = cell.in_run ? Ground::run : Ground::free;
    word.present = cell.amount;
    if (hot_) word.content = cell.amount * cell.heat;
    word.head = cell.head;
    word.mobility = cell.mobility;
    word.exposed = cell.exposed;
    word.dead = cell.dead;
    return word;
  }

  // q has come, at x.
  void look(SpreadWord* q, SpreadWord* w, SpreadWord* s, SpreadWord* sw, int x) {
    if (walls_) note_walls(q, w, s, x);
    const bool any = q->runs() || (w != nullptr && w->runs()) || (s != nullptr && s->runs()) ||
                     (w != nullptr && s != nullptr && sw->runs());
    if (!any) return;
    const int z = came().z;
    if (w != nullptr) pair({q, x, z}, {w, x - 1, z}, 0);
    if (s != nullptr) pair({q, x, z}, {s, x, z - 1}, 1);
    if (w == nullptr || s == nullptr) return;
    if (!w->blocked() || !s->blocked()) pair({q, x, z}, {sw, x - 1, z - 1}, 2);
    if (!q->blocked() || !sw->blocked()) pair({w, x - 1, z}, {s, x, z - 1}, 3);
  }

  void note_walls(SpreadWord* q, SpreadWord* w, SpreadWord* s, int x) const {
    if (w == nullptr || w->blocked() || s == nullptr || s->blocked() || x == shape().grid.x - 1)
      q->beside_wall = 1;
    if (!q->blocked()) return;
    if (w != nullptr) w->beside_wall = 1;
    if (s != nullptr) s->beside_wall = 1;
  }

  void pair(Seen a, Seen b, int axis) {
    if (a.word->blocked() || b.word->blocked() || a.word->head == b.word->head) return;
    a.word->head > b.word->head ? flow(a, b, axis) : flow(b, a, axis);
  }

  // From the one with the higher head.
  void flow(Seen from, Seen to, int axis) {
    SpreadWord& giver = *from.word;
    SpreadWord& taker = *to.word;
    if (!giver.runs()) return;
    const bool diagonal = axis >= 2;
    const std::int64_t zone = diagonal ? (11 * giver.dead) >> 3 : std::int64_t{giver.dead};
    const std::int64_t drop = giver.head - taker.head;
    const bool rests = drop <= zone;
    if (rests && !armed(Fault::viscous_dead_zone)) return;
    const UInt<16> amount =
        wanted(giver, taker, drop, diagonal, axis_dither_[static_cast<std::size_t>(axis)]);
    if (armed(Fault::viscous_dither)) [[unlikely]] {
      const UInt<16> other =
          wanted(giver, taker, drop, diagonal, axis_dither_[static_cast<std::size_t>(axis + 1) % 4]);
      if (other != amount) {
        strike_first(from.x, from.z, to.x, to.z, came().y);
        return move(giver, taker, other, other);
      }
    }
    if (amount == 0) return;
    if (rests) [[unlikely]]
      strike_first(from.x, from.z, to.x, to.z, came().y);
    const bool lost = armed(Fault::viscous_flow_lost);
    if (lost) [[unlikely]]
      strike(to.x, came().y, to.z);
    move(giver, taker, amount, lost ? 0 : std::int64_t{amount});
  }

  static std::int64_t wanted(const SpreadWord& giver, const SpreadWord& taker, std::int64_t drop,
                             bool diagonal, std::int64_t dither) {
    const UInt<9> capped = std::min<std::int64_t>(drop, diagonal ? 362 : 256);
    const UInt<15> mobility = (taker.runs() ? giver.mobility : giver.exposed) + taker.mobility;
    const UInt<16> conductance = std::min<std::int64_t>(65535, (mobility * giver.amount) >> 12);
    const UInt<25> product = std::int64_t{conductance} * capped;
    const std::int64_t flows = diagonal ? (product + (dither >> 1)) >> 15 : (product + (dither >> 3)) >> 13;
    const std::int64_t room = std::max<std::int64_t>(0, (taker.runs() ? kAmountMax : kOne) - taker.amount);
    return std::min({flows, std::int64_t{giver.amount} >> 3, room >> 3});
  }

  void move(SpreadWord& giver, SpreadWord& taker, std::int64_t leaves, std::int64_t arrives) const {
    giver.present = giver.present - leaves;
    taker.present = taker.present + arrives;
    if (!hot_) return;
    giver.content = giver.content - leaves * giver.heat;
    taker.content = taker.content + arrives * giver.heat;
  }

  // All pairs of this cell are done. A cell that took nothing mixes to its own heat again: it needs no flag.
  void finish(SpreadWord& word) const {
    if (word.blocked()) return;
    word.amount = word.present;
    if (!hot_) return;
    word.heat = 0;
    if (word.present > 0) word.heat = mix(word.content, word.present, dither_);
  }

  void give(const SpreadWord& word, Cell& cell) const {
    cell = {};
    cell.amount = word.amount;
    cell.heat = word.heat;
    cell.state = word.ground == Ground::solid ? State::solid : State::inert;
    if (word.blocked()) return;
    cell.state = State::liquid;
    cell.settle_state();
    cell.in_run = word.runs();
    cell.beside_wall = word.beside_wall;
  }

  bool hot_, walls_;
  int head_bits_;
  UInt<16> dither_;
  std::array<UInt<16>, 4> axis_dither_;
  TapLine<SpreadWord> line_;
};

}  // namespace

std::unique_ptr<Stage> make_viscous_spread(const Design& design) {
  return std::make_unique<ViscousSpread>(design);
}

}  // namespace voxmelt::hwmodel
