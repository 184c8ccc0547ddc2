// Spread under the viscous law follows docs/automaton.md section 11.
#include "state.h"

#include <vector>

namespace oracle {
namespace {

// Returns the slope of an axis or of a diagonal by t: floor((numerator + floor(q / 2)) / q).
constexpr Int slope(Int t, bool diagonal) {
  const Int root = 65536 + 256 * t * t + t * t * t * t;
  const Int q = diagonal ? root * root : 256 + 2 * t * t;
  const Int numerator = Int{1} << (diagonal ? 46 : 22);
  return (numerator + q / 2) / q;
}

// The page lists the same from t = 0 on, first for an axis, then for a diagonal.
constexpr Int SLOPES[2][17] = {{16384, 16257, 15888, 15308, 14564, 13707, 12788, 11848, 10923, 10034, 9198,
                                8422, 7710, 7061, 6473, 5941, 5461},
                               {16384, 16256, 15876, 15254, 14407, 13365, 12168, 10864, 9511, 8165, 6880,
                                5696, 4641, 3730, 2962, 2331, 1820}};
constexpr bool slopes_are_as_listed() {
  for (Int t = 0; t <= 16; ++t)
    if (slope(t, false) != SLOPES[0][t] || slope(t, true) != SLOPES[1][t]) return false;
  return true;
}
static_assert(slopes_are_as_listed());

// Returns t. `giver` and `taker` are what the cells of the pair show.
Int tilt(const Run& giver, const Run& taker) {
  if (!taker.bed.has_value()) return 0;
  const Int difference = (*giver.bed >> 5) - (*taker.bed >> 5);
  return smaller(16, larger(difference, -difference));
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
  if (direction.diagonal) return slope(t, true);
  return slope(t, false) + blocked_beside(state, at, direction) * (slope(t, true) >> 3);
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

// Lets the run cell i give in a direction. The pair is computed once, by its giver.
void give(State& state, Int i, Place at, const Direction& direction) {
  if (!is_open(state, at, direction)) return;
  const Run& giver = state.runs[i];
  const Int x = at.x + direction.dx, z = at.z + direction.dz;
  const Int j = state.index(x, at.y, z);
  const Run taker = shown_by(state, x, at.y, z);
  const Int threshold = direction.diagonal ? (11 * giver.dead) >> 3 : giver.dead;
  const Int whole_drop = giver.head - taker.head;
  if (whole_drop <= 0 || whole_drop <= threshold) return;

  const Int drop = smaller(whole_drop, direction.diagonal ? 724 : 512);
  const Int t = tilt(giver, taker);
  const Int drive = (slope_of_pair(state, at, direction, t) * drop) >> 10;
  const Int A_i = state.cells[i].amount, A_j = state.cells[j].amount;
  Int m = (taker.member == 1 ? giver.mobility : giver.exposed) + taker.mobility;
  if (taker.limit.has_value()) m = smaller(m, 512 * *giver.limit);
  const Int c = smaller((Int{1} << 24) - 1, (m * amount_between(taker, t, A_i, A_j)) >> 12);
  const Int R = rounding(state, direction.axis, at.y);
  const Int w = direction.diagonal ? (c * drive + (R << 12)) >> 28 : (c * drive + (R << 10)) >> 26;
  const Int room = larger(0, (taker.member == 1 ? AMAX : ONE) - A_j);
  const Int fifth = scaled(smaller(A_i, room), 13107);
  const Int f = smaller(w, direction.diagonal ? fifth >> 2 : fifth);
  if (f == 0) return;
  state.touch(j);
  state.exchanges[i].given += f;
  state.exchanges[j].taken += f;
  state.exchanges[j].heat_taken += f * state.cells[i].heat;
}

}  // namespace

void spread_viscous(State& state) {
  const std::vector<Int> before = state.list;  // the list grows as cells take
  for (const Int i : before) {
    if (state.runs[i].member == 0) continue;
    const Place at = state.place(i);
    for (const Direction& direction : DIRECTIONS) give(state, i, at, direction);
  }
  move_exchanged(state);
  finish_phase(state, "after spread");
}

}  // namespace oracle
