// The stage runs the phase `spread` of the viscous law (docs/automaton.md, section 11). A pair is done when
// its two cells have come and, for a diagonal, its corners, for an axis, the four cells beside it. So a cell
// q that comes completes four pairs: q with SW and W with S across, S with SW along x, and W with SW along z.
// The words of a pair's cells keep what lay beside them before, and how far its bed differed. Each pair is
// computed once and booked at both cells, in the taps.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/run_reader.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

struct SpreadPair {
  int axis;
  UInt<5> across;              // rise of the beds across the pair
  UInt<3> blocked_beside = 0;  // blocked cells of the four beside an axis pair
};

template <class Faults>
class ViscousSpread final : public Stage {
 public:
  explicit ViscousSpread(const Design& design, Faults faults = {})
      : Stage(StageKind::viscous_spread, design, design.shape.plane() + design.shape.column()),
        faults_(faults),
        hot_(design.hot()),
        walls_(design.needs_walls()),
        head_bits_(RunWidths(design).head),
        solids_(design),
        line_(lanes(), lag()),
        floor_(lanes(), design.shape.blocks() + 1),
        now_(lanes()),
        south_(now_) {}

  // Only the last lane of a token has a pair left (its diagonal to the next block) after one plane.
  Wires side_bands() const override {
    return Wires{Wire::in_run}.add(Wire::beside_wall, walls_).add(Wire::set, design().freezes());
  }
  std::vector<BufferCost> buffers() const override {
    const std::int64_t open = SpreadWord::bits(head_bits_, design()), done = SpreadWord::done_bits(design());
    const std::int64_t column = shape().column(), between = shape().plane() - column;
    std::vector<BufferCost> costs{{"column memory", column, lanes(), open}};
    if (between > 0) costs.push_back({"plane memory", between, lanes(), open});
    if (lanes() > 1) costs.push_back({"column memory, done", column, lanes() - 1, done});
    costs.push_back({"column memory, last lane", column, 1, open});
    costs.push_back({"floor memory", shape().blocks(), lanes(), RunPace::kBits});
    costs.push_back({"floor memory, last lane", 1, 1, RunPace::kBits});
    if (hot_) add_table(costs, "beds of the materials", design(), SolidBed::kRowBits);
    return costs;
  }

  // In the circuit a sum of what a cell got is known 25 registers after its word, so it has a memory of its
  // own. A word is what a run shows, and with heat that of the cell. The bits are those of spread_stage.sv.
  std::vector<BufferCost> circuit_buffers() const override {
    const bool warm = hot_ || design().of_materials();
    const int heat = warm ? 16 : 0, word = 92 + heat, done = 20 + heat, sum = warm ? 48 : 16;
    const std::int64_t column = shape().column(), between = shape().plane() - column;
    std::vector<BufferCost> costs{{"column memory", column, lanes(), word},
                                  {"column memory, sums", column, lanes(), sum},
                                  {"column memory, done", column + 22, lanes(), done},
                                  {"column memory, last lane", column, 1, word},
                                  {"column memory, sums of the last lane", column, lanes(), sum},
                                  {"floor memory", shape().blocks(), lanes(), RunPace::kBits}};
    if (between > 0) {
      costs.push_back({"plane memory", between, lanes(), word});
      costs.push_back({"plane memory, sums", between, lanes(), sum});
    }
    return costs;
  }

  // A pair multiplies (g + mobility) a, slope x drop and c drive, and with heat f h. The slope's factor is
  // read from a table of 512 words, by squares from tables of 33. An axis adds up to four eighths of it. With
  // heat, a cell multiplies A h and the mixture's rounding, and two multipliers serve the bed of a solid.
  Units units() const override { return {13 + (hot_ ? 4 + 2 + 2 : 0), hot_ ? 1 : 0, 0}; }

 protected:
  void begin_step() override {
    const int k = moment().substep;
    dithers_.next(UInt<16>::truncated(dither_of(step()) + dither_of(k)));
    substep_ = Reciprocal(moment().substeps);
    for (int axis = 0; axis < 4; ++axis) step_dither_[axis] = dither_of(step(), axis, 4);
  }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    if (came().y == 0) floor_.shift();
    const UInt<16> layer = dither_of(came().y);
    for (int axis = 0; axis < 4; ++axis) axis_dither_[axis] = pair_dither(axis, layer, moment().substep);
    const std::size_t column = shape().column();
    const std::size_t plane = shape().plane();
    const std::size_t blocks = shape().blocks();
    const int end = lanes() - 1, x = came().x, z = came().z;
    SpreadWord* now = line_.tap(0);
    SpreadWord* south = line_.tap(plane);
    SpreadWord* last = line_.tap(plane + column);
    if (in != nullptr)
      for (const int lane : each_lane()) take(in[lane], lane, now[lane]);
    read(now_.data(), now, lanes(), floor_.tap(0), x);
    read(&west_, line_.tap(column) + end, 1, floor_.tap(1) + end, x - 1);
    read(south_.data(), south, lanes(), floor_.tap(blocks), x);
    read(&south_west_, last + end, 1, floor_.tap(blocks + 1) + end, x - 1);

    const Tap* west = came().has_west() ? &west_ : nullptr;
    const Tap* south_west = &south_west_;
    for (const int each : each_lane()) {
      const std::size_t lane = each;
      const bool corner = west != nullptr && z > 0;
      look(now_[lane].seen, west != nullptr ? &west->seen : nullptr, z > 0 ? &south_[lane].seen : nullptr,
           corner ? &south_west->seen : nullptr, z);
      west = &now_[lane];
      south_west = &south_[lane];
    }

    dither_ = at(dithers_, shape().plane());
    if (z > 0 || ends_last_pass())
      for (int lane = 0; lane < end; ++lane) {
        compute_at(shape().plane(), lane);
        finish(south[lane]);
      }
    if (out == nullptr) return;
    dither_ = at(dithers_, lag());
    compute_at(lag(), end);
    finish(last[end]);
    for (int lane = 0; lane < lanes(); ++lane) {
      give(last[lane], out[lane]);
      faults_.gave(*this, lane, out[lane]);
    }
  }

 private:
  friend Faults;

  struct Tap {
    RunReader reader;
    SeenCell seen;
  };

  void take(const Cell& cell, int lane, SpreadWord& word) {
    word.amount = cell.amount;
    if (hot_) word.heat = cell.heat;
    if (cell.blocked()) {
      word.ground = cell.state == State::solid ? Ground::solid : Ground::inert;
      word.material = cell.material;
      if (cell.state == State::solid) word.melted = solids_.rise(cell.amount, cell.heat, cell.material);
      return;
    }
    word.ground = cell.in_run ? Ground::run : Ground::outside;
    word.set = cell.set;
    word.present = cell.amount;
    if (hot_) word.content = cell.amount * cell.heat;
    RunReader& reader = now_[lane].reader;
    if (!cell.in_run || !reader.above_blocked(came().y)) return;
    word.head = signed_wire(cell.head, head_bits_);
    const RunPace pace{cell.mobility, cell.limit, cell.dead, cell.shut};
    reader.bring(pace);
    if (came().y == 0)
      floor_.tap(0)[lane] = pace;
    else
      line_.tap(1)[lane].above = pace;
  }

  void read(Tap* taps, SpreadWord* words, int count, const RunPace* floor, int x) {
    for (int lane = 0; lane < count; ++lane) {
      Tap& tap = taps[lane];
      if (came().y == 0) tap.reader.bring_floor(floor[lane]);
      tap.seen.word = words + lane;
      tap.seen.x = x + lane;
      tap.reader.read(tap.seen, came().y);
    }
  }

  // Computes the pairs that q completes. A null cell is outside of the grid. Beside the border in the east
  // and the north nothing else will come. The units that do those pairs here are idle when the next row, or
  // the next plane, begins.
  void look(const SeenCell& q, const SeenCell* w, const SeenCell* s, const SeenCell* sw, int z) {
    if (walls_) note_walls(*q.word, w != nullptr ? w->word : nullptr, s != nullptr ? s->word : nullptr, q.x);
    q.word->west_blocked = blocked(w);
    q.word->south_blocked = blocked(s);
    q.word->west_rise = rise(w, &q);
    q.word->south_rise = rise(s, &q);
    const bool any = q.word->runs() || (w != nullptr && w->word->runs()) ||
                     (s != nullptr && s->word->runs()) || (sw != nullptr && sw->word->runs());
    if (!any) return;
    if (q.x == shape().grid.x - 1 && s != nullptr) pair(q, *s, beside_x(q, *s, nullptr, nullptr));
    if (z == shape().grid.z - 1 && w != nullptr) pair(q, *w, beside_z(q, *w, nullptr, nullptr));
    if (sw == nullptr) return;
    if (q.x < shape().grid.x) pair(*w, *sw, beside_x(*w, *sw, &q, s));
    if (z < shape().grid.z) pair(*s, *sw, beside_z(*s, *sw, &q, w));
    if (!w->blocked() || !s->blocked()) pair(q, *sw, {2, across({rise(w, s), 0, 0, 0})});
    if (!q.blocked() || !sw->blocked()) pair(*w, *s, {3, across({rise(&q, sw), 0, 0, 0})});
  }

  // Return what lies beside a pair along z, or along x. The two cells that came later may be outside of the
  // grid.
  static SpreadPair beside_x(const SeenCell& a, const SeenCell& b, const SeenCell* later_a,
                             const SeenCell* later_b) {
    return {1, across({a.word->west_rise, b.word->west_rise, rise(&a, later_a), rise(&b, later_b)}),
            beside(blocked(later_a), blocked(later_b)) + beside(a.word->west_blocked, b.word->west_blocked)};
  }
  static SpreadPair beside_z(const SeenCell& a, const SeenCell& b, const SeenCell* later_a,
                             const SeenCell* later_b) {
    return {
        0, across({a.word->south_rise, b.word->south_rise, rise(&a, later_a), rise(&b, later_b)}),
        beside(blocked(later_a), blocked(later_b)) + beside(a.word->south_blocked, b.word->south_blocked)};
  }
  // Walks across a pair: by the rises from what came before to its cells, and on to what came later.
  static UInt<5> across(const std::array<std::int64_t, 4>& rises) {
    const auto [low, high] = std::minmax_element(rises.begin(), rises.end());
    const std::int64_t up = std::max<std::int64_t>(0, *high), down = std::max<std::int64_t>(0, -*low);
    return std::max(up, down) - std::min(up, down);
  }
  static std::int64_t rise(const SeenCell* from, const SeenCell* to) {
    return from == nullptr || to == nullptr ? 0 : std::int64_t{bed_rise(*from, *to)};
  }

  static bool blocked(const SeenCell* cell) { return cell == nullptr || cell->word->blocked(); }
  static int beside(bool one, bool other) { return int{one} + int{other}; }

  void note_walls(SpreadWord& q, SpreadWord* w, SpreadWord* s, int x) const {
    if (w == nullptr || w->blocked() || s == nullptr || s->blocked() || x == shape().grid.x - 1 ||
        came().z == shape().grid.z - 1)
      q.beside_wall = 1;
    if (!q.blocked()) return;
    if (w != nullptr) w->beside_wall = 1;
    if (s != nullptr) s->beside_wall = 1;
  }

  void pair(const SeenCell& a, const SeenCell& b, const SpreadPair& pair) {
    if (a.blocked() || b.blocked() || a.head == b.head) return;
    a.head > b.head ? flow(a, b, pair) : flow(b, a, pair);
  }

  // Returns the dither of sub-step k, in the layer with this dither. The lanes of a token share it.
  UInt<16> pair_dither(int axis, std::int64_t layer, int k) const {
    const UInt<16> offset = UInt<16>::truncated(step_dither_[axis] + layer);
    return substep_.times(offset + 65536 * std::int64_t{turn_of(k, moment().substeps, axis)});
  }
  static bool is_diagonal(int axis) { return axis >= 2; }
  std::int64_t dither_of_axis(int axis) const { return axis_dither_[axis]; }

  // Lets liquid flow from the cell with the higher head.
  void flow(const SeenCell& from, const SeenCell& to, const SpreadPair& pair) {
    if (!from.word->runs()) return;
    const bool rests = from.word->set > 0 || closed(from, to) || in_dead_zone(from, to, pair.axis);
    UInt<16> amount = rests ? 0 : wanted(from, to, pair, dither_of_axis(pair.axis));
    faults_.wanted(*this, from, to, pair, amount);
    if (amount == 0) return;
    move(*from.word, *to.word, amount);
    faults_.moved(*this, from, to, amount);
  }

  // Returns true between two shut runs.
  static bool closed(const SeenCell& from, const SeenCell& to) { return from.pace.shut && to.pace.shut; }

  static bool in_dead_zone(const SeenCell& from, const SeenCell& to, int axis) {
    const std::int64_t dead = from.pace.dead;
    return from.head - to.head <= (is_diagonal(axis) ? (11 * dead) >> 3 : dead);
  }

  // Returns the factor of the slope, in 1/16384. The hardware has a table of 512 words.
  static UInt<15> slope_factor(const SeenCell& from, const SeenCell& to, const SpreadPair& pair) {
    const std::int64_t along = bed_rise(from, to), across = pair.across;
    const std::int64_t square = (along * along + across * across) >> (is_diagonal(pair.axis) ? 1 : 0);
    const std::int64_t root = (1 << 22) / (256 + std::min<std::int64_t>(511, square));
    return root * root >> 14;
  }

  // Returns the amount at the face, which lies between the columns. On a slope the giver's amount alone
  // counts.
  static UInt<16> flowing(const SeenCell& from, const SeenCell& to) {
    if (from.bed == kNoBed || from.bed != to.bed) return from.word->amount;
    return (from.word->amount + to.word->amount + 1) >> 1;
  }

  static std::int64_t wanted(const SeenCell& from, const SeenCell& to, const SpreadPair& pair,
                             std::int64_t dither) {
    const bool diagonal = is_diagonal(pair.axis);
    const UInt<15> plane = slope_factor(from, to, pair);
    const UInt<15> slope = plane + pair.blocked_beside * (plane >> 3);
    const std::int64_t drop = from.head - to.head;
    const SpreadWord& giver = *from.word;
    const SpreadWord& taker = *to.word;
    const UInt<10> capped = std::min<std::int64_t>(drop, diagonal ? 724 : 512);
    std::int64_t mobility = (taker.runs() ? from.pace.limited() : from.pace.exposed()) + to.pace.limited();
    if (to.pace.limit > 0) mobility = std::min<std::int64_t>(mobility, from.pace.limit << 9);
    const UInt<39> conducted = UInt<23>(mobility) * flowing(from, to);
    const UInt<24> conductance = std::min<std::int64_t>((1 << 24) - 1, conducted >> 12);
    const UInt<14> drive = (slope * std::int64_t{capped}) >> 10;
    const UInt<38> product = std::int64_t{conductance} * drive;
    const std::int64_t flows = diagonal ? (product + (dither << 12)) >> 28 : (product + (dither << 10)) >> 26;
    const std::int64_t room = std::max<std::int64_t>(0, (taker.runs() ? kAmountMax : kOne) - taker.amount);
    const std::int64_t most = (std::min(std::int64_t{giver.amount}, room) * 13107) >> 16;
    return std::min(flows, diagonal ? most >> 2 : most);
  }

  void move(SpreadWord& giver, SpreadWord& taker, std::int64_t amount) const {
    giver.present = giver.present - amount;
    taker.present = taker.present + amount;
    if (!hot_) return;
    giver.content = giver.content - amount * giver.heat;
    taker.content = taker.content + amount * giver.heat;
  }

  // Finishes a cell whose pairs are all done. A cell that took nothing mixes to its own heat again, so it
  // needs no flag.
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
    cell.material = word.material;
    if (word.blocked()) return;
    cell.state = State::liquid;
    cell.settle_state();
    cell.in_run = word.runs();
    cell.beside_wall = word.beside_wall;
    cell.set = word.set;
  }

  [[no_unique_address]] Faults faults_;
  bool hot_, walls_;
  int head_bits_;
  SolidBed solids_;
  OfTwoPasses<UInt<16>> dithers_;
  UInt<16> dither_;                                    // dither of the cells that are finished
  Reciprocal substep_{1};                              // divides a step by its number of sub-steps
  std::array<UInt<16>, 4> step_dither_, axis_dither_;  // for the step; for the token's pairs
  TapLine<SpreadWord> line_;
  TapLine<RunPace> floor_;  // paces of runs on the grid's floor; moves once per column
  std::vector<Tap> now_, south_;
  Tap west_, south_west_;  // taps of the last lane
};

}  // namespace voxmelt::hwmodel
