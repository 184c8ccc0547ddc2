// Spread under the viscous law follows docs/automaton.md section 11.
#include "pair.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace oracle {
namespace {

// Returns `plane`, which is 16384 / (1 + q / 256)^2.
constexpr Int plane_of(Int q) {
  const Int root = (Int{1} << 22) / (256 + q);
  return (root * root) >> 14;
}
static_assert(plane_of(0) == 16384 && plane_of(256) == 4096);

// Returns the bed that a cell shows. A blocked one shows none.
std::optional<Int> bed_at(const State& state, Place at) {
  if (state.blocked(at.x, at.y, at.z)) return std::nullopt;
  return shown_by(state, at.x, at.y, at.z).bed;
}

// Returns how far the bed rises from one cell to another, in 1/16 cell. It is below 0 where the bed falls.
Int climb(const State& state, Place from, Place to) {
  const std::optional<Int> bed_from = bed_at(state, from), bed_to = bed_at(state, to);
  if (!bed_from.has_value() || !bed_to.has_value()) return 0;
  const Int difference = (*bed_to >> 5) - (*bed_from >> 5);
  return larger(-31, smaller(31, difference));
}

// Returns the rise of two cells, in 1/16 cell.
Int rise(const State& state, Place a, Place b) {
  const Int difference = climb(state, a, b);
  return larger(difference, -difference);
}

// Returns `across` of the pair of a cell and its neighbour in a direction.
Int rise_across(const State& state, Place at, const Direction& direction) {
  const Int dx = direction.dx, dz = direction.dz;
  if (direction.diagonal) return rise(state, {at.x + dx, at.y, at.z}, {at.x, at.y, at.z + dz});
  Int up = 0, down = 0;
  for (const Place own : {at, Place{at.x + dx, at.y, at.z + dz}}) {
    const Place before{own.x - dz, own.y, own.z - dx}, behind{own.x + dz, own.y, own.z + dx};
    for (const Int step : {climb(state, before, own), climb(state, own, behind)}) {
      up = larger(up, step);
      down = larger(down, -step);
    }
  }
  return larger(up - down, down - up);
}

// Returns p of a pair across an axis: how many of the four cells beside it are blocked.
Int blocked_beside(const State& state, Place at, const Direction& direction) {
  Int p = 0;
  for (const Int side : {Int{-1}, Int{1}}) {
    const Int x = at.x + side * direction.dz, z = at.z + side * direction.dx;  // beside i
    if (state.blocked(x, at.y, z)) ++p;
    if (state.blocked(x + direction.dx, at.y, z + direction.dz)) ++p;
  }
  return p;
}

// Returns s: an axis also has an eighth for each blocked cell beside it.
Int slope_of_pair(const State& state, Place at, const Direction& direction, Int t) {
  const Int across = rise_across(state, at, direction);
  const Int squares = t * t + across * across;
  const Int plane = plane_of(smaller(511, direction.diagonal ? squares >> 1 : squares));
  return direction.diagonal ? plane : plane + blocked_beside(state, at, direction) * (plane >> 3);
}

// Returns R of an axis between cells at height y.
Int rounding(const State& state, Int axis, Int y) {
  const Int D = (dither(state.step, axis, 4) + dither(y)) % 65536;
  const Int u = state.substep, K = state.substeps;
  return (D + 65536 * ((u + axis * K / 4) % K)) / K;
}

// Returns a, the amount that the pair holds at its face.
Int amount_between(const Run& taker, Int t, Int A_i, Int A_j) {
  const bool level = taker.bed.has_value() && t == 0;
  return level ? (A_i + A_j + 1) >> 1 : A_i;
}

// Returns m of a pair, as far as the giver's limit lets it.
Int mobility_of_pair(const Stages& stages, const Run& giver, const Run& taker) {
  const Int m = (taker.member == 1 ? giver.mobility : giver.exposed) + taker.mobility;
  if (!taker.limit.has_value()) return m;
  if (stages.S == 1) return smaller(m, 512 * *giver.limit);
  if (taker.member == 1) return smaller(m, *giver.limit << (9 + stages.bits));
  const Int limit = larger(1, (*giver.limit * scale_of(stages)) >> (14 + stages.bits));
  return smaller(m, limit << (8 + stages.bits));
}

// Adds the pair of the run cell i and its neighbour in a direction, if i gives, is not set and not both are
// shut.
void find_pair(State& state, Int i, const Direction& direction, std::vector<Pair>& pairs) {
  const Place at = state.place(i);
  if (!is_open(state, at, direction)) return;
  const Run& giver = state.runs[i];
  const Int x = at.x + direction.dx, z = at.z + direction.dz;
  const Int j = state.index(x, at.y, z);
  const Run taker = shown_by(state, x, at.y, z);
  const Int drop = giver.head - taker.head;
  const Int threshold = direction.diagonal ? (11 * giver.dead) >> 3 : giver.dead;
  if (drop <= 0 || drop <= threshold) return;
  if (giver.shut && taker.shut) {
    ++state.pair_counts.shut;
    return;
  }
  if (state.is_set(i)) {
    ++state.freeze_counts.kept;
    return;
  }

  const Int t = rise(state, at, {x, at.y, z});
  const Int a = amount_between(taker, t, state.cells[i].amount, state.cells[j].amount);
  const Int m = mobility_of_pair(state.stages, giver, taker);
  Pair pair;
  pair.i = i;
  pair.j = j;
  pair.direction = direction;
  pair.between_runs = taker.member == 1;
  pair.drop = drop;
  pair.s = slope_of_pair(state, at, direction, t);
  pair.c = smaller((Int{1} << (24 + state.stages.bits)) - 1, (m * a) >> 12);
  pairs.push_back(pair);
}

// Returns w by the drop of the heads, with one stage.
Int wanted_flow(const Pair& pair, Int R) {
  const bool diagonal = pair.direction.diagonal;
  const Int drive = (pair.s * smaller(pair.drop, diagonal ? 724 : 512)) >> 10;
  return diagonal ? (pair.c * drive + (R << 12)) >> 28 : (pair.c * drive + (R << 10)) >> 26;
}

// Returns w by a relaxed drop, in 1/32768 cell.
Int wanted_flow_relaxed(const Pair& pair, Int bits, Int whole_drop, Int R) {
  const bool diagonal = pair.direction.diagonal;
  const Int drop = smaller(whole_drop, diagonal ? 46336 : 32768);
  const Int drive = (2 * pair.s * drop) >> 16;
  const Int part = (pair.c * drive) >> (8 + bits);
  return diagonal ? (part + (32 * R >> bits)) >> (21 - bits) : (part + (8 * R >> bits)) >> (19 - bits);
}

// Moves w, or as much of it as giver and receiver let, and returns what it moved.
Int move(State& state, const Pair& pair, Int from, Int to, Int w) {
  const Int A = state.cells[from].amount;
  const Int room = larger(0, (pair.between_runs ? AMAX : ONE) - state.cells[to].amount);
  const Int fifth = scaled(smaller(A, room), 13107);
  const Int f = smaller(w, pair.direction.diagonal ? fifth >> 2 : fifth);
  if (f == 0) return f;
  state.touch(to);
  state.exchanges[from].given += f;
  state.exchanges[to].taken += f;
  state.exchanges[to].heat_taken += f * state.cells[from].heat;
  return f;
}

// Lets the pairs flow by the mean drops of their sub-step.
void flow_relaxed(State& state, const std::vector<Pair>& pairs) {
  const std::vector<Int> drops = relaxed_drops(state, pairs);
  for (std::size_t n = 0; n < pairs.size(); ++n) {
    const Pair& pair = pairs[n];
    const Int R = rounding(state, pair.direction.axis, state.place(pair.i).y);
    const Int drop = pair.between_runs ? drops[n] : 64 * pair.drop;
    const Int w = wanted_flow_relaxed(pair, state.stages.bits, larger(drop, -drop), R);
    if (drop < 0 && state.is_set(pair.j)) {
      ++state.pair_counts.relaxed;
      if (w > 0) ++state.freeze_counts.not_back;
      continue;
    }
    const Int back = drop < 0 ? move(state, pair, pair.j, pair.i, w) : 0;
    if (drop > 0) move(state, pair, pair.i, pair.j, w);
    if (pair.between_runs) ++state.pair_counts.relaxed;
    if (back > 0) ++state.pair_counts.back;
  }
}

}  // namespace

void spread_viscous(State& state) {
  std::vector<Pair> pairs;  // each once, found by its giver
  for (const Int i : state.list) {
    if (state.runs[i].member == 0) continue;
    for (const Direction& direction : DIRECTIONS) find_pair(state, i, direction, pairs);
  }
  if (state.stages.S > 1) {
    flow_relaxed(state, pairs);
  } else {
    for (const Pair& pair : pairs)
      move(state, pair, pair.i, pair.j,
           wanted_flow(pair, rounding(state, pair.direction.axis, state.place(pair.i).y)));
  }
  move_exchanged(state);
  finish_phase(state, "after spread");
}

}  // namespace oracle
