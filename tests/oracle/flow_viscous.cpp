// docs/automaton.md sections 10 (settle) and 11 (spread), viscous law.
#include "state.h"

#include <string>
#include <vector>

namespace oracle {
namespace {

// The height of the surface below the cell (x, y, z), in 1/256 cell.
Int bed_of(const State& state, Int x, Int y, Int z) {
  Int b = FLAT;
  if (y > 0) {
    const Cell& below = state.cells[state.index(x, y - 1, z)];
    if (below.inert == 1) b = below.amount;
  }
  return 256 * y + ((b - FLAT) >> 4);
}

// The number of cells of the run that starts at y0.
Int run_length(const State& state, Int x, Int y0, Int z) {
  Int n = 0;
  Int mass = 0;
  for (;;) {
    const Int last = state.cells[state.index(x, y0 + n, z)].amount;
    mass += last;
    ++n;
    if (state.blocked(x, y0 + n, z)) return n;
    const Int next = state.cells[state.index(x, y0 + n, z)].amount;
    if (mass <= n * ONE && !(last >= ONE / 2 && next > 0)) return n;
  }
}

// What the cells of a run of mass M with heat h over the bed show.
Run shown_by_run(const Parameters& parameters, Int bed, Int M, Int over, Int h) {
  const ViscousFlow& viscous = parameters.viscous;
  Run run;
  run.member = 1;
  run.bed = bed;
  run.head = bed + (M >> 4) + (viscous.stiffness - 1) * (over >> 4);
  const Int depth = larger(1, M >> 4);
  const Int cut = smaller(depth, 16384);
  Int raw = (viscous.mobility * cut * cut + (Int{1} << 19)) >> 20;
  if (parameters.thermal_viscosity) raw = (raw * parameters.mobility_table[h >> 11]) >> 15;
  run.exposed = smaller(raw, 8192);
  Int limit = 8192 / ((M >> 12) + 1);
  if (over > 0) limit /= viscous.stiffness;
  run.mobility = smaller(raw, limit);
  run.dead = larger(1, (viscous.yield + depth / 2) / depth);
  return run;
}

// The indices of the n cells of the run that starts at y0, upwards.
std::vector<Int> cells_of_run(const State& state, Int x, Int y0, Int z, Int n) {
  std::vector<Int> cells;
  for (Int k = 0; k < n; ++k) cells.push_back(state.index(x, y0 + k, z));
  return cells;
}

// The flows through the inner faces of a run: face k lies above cell k.
struct FaceFlows {
  bool keep_order = false;
  std::vector<Int> up, down;
};

// The flows that settle a run of mass M, and whether they are to be used.
FaceFlows face_flows(const State& state, const std::vector<Int>& run, Int M, Int over) {
  FaceFlows flows;
  flows.keep_order = over == 0;
  Int P = 0;
  for (Int k = 0; k + 1 < static_cast<Int>(run.size()); ++k) {
    P += state.cells[run[k]].amount;
    const Int excess = P - (k + 1) * ONE;
    if (excess < -(AMAX - ONE) || excess > AMAX - ONE) flows.keep_order = false;
    flows.up.push_back(larger(0, excess));
    flows.down.push_back(larger(0, smaller((k + 1) * ONE, M) - P));
  }
  return flows;
}

// What docs/proofs.md promises: no giver lacks what it gives, and no receiver holds more than AMAX.
void move_through_face(State& state, Int from, Int to, Int f) {
  if (f == 0) return;
  Cell& giver = state.cells[from];
  Cell& receiver = state.cells[to];
  if (f > giver.amount || f > AMAX - receiver.amount)
    throw Violation("step " + std::to_string(state.step) + ": a flow of " + std::to_string(f) +
                    " inside a run, from cell " + std::to_string(from) + " to cell " + std::to_string(to));
  mix_heat(state, receiver, giver, f);
  giver.amount -= f;
  receiver.amount += f;
}

void move_through_faces(State& state, const std::vector<Int>& run, const FaceFlows& flows) {
  const Int faces = static_cast<Int>(flows.up.size());
  for (Int k = 0; k < faces; ++k) move_through_face(state, run[k], run[k + 1], flows.up[k]);
  for (Int k = faces - 1; k >= 0; --k) move_through_face(state, run[k + 1], run[k], flows.down[k]);
}

// All cells of a run of mass M get one heat; `products` is the sum of a h over them.
void mix_all(State& state, const std::vector<Int>& run, Int M, Sum products) {
  if (!state.parameters.heat.enabled) return;
  const Int h = mixed(static_cast<Int>(products), M, state.offset);
  for (const Int i : run) state.cells[i].heat = h;
  state.ledgers.heat.rounded += Sum{M} * h - products;
}

// Settles the run of n cells that starts at y0.
void settle_run(State& state, Int x, Int y0, Int z, Int n) {
  const std::vector<Int> run = cells_of_run(state, x, y0, z, n);
  Int M = 0;
  Sum products = 0;
  for (const Int i : run) {
    M += state.cells[i].amount;
    products += state.cells[i].amount * state.cells[i].heat;
  }
  const Int over = larger(0, M - n * ONE);
  const Int mean_heat = static_cast<Int>(products / M);
  const Run shown = shown_by_run(state.parameters, bed_of(state, x, y0, z), M, over, mean_heat);
  const FaceFlows flows = face_flows(state, run, M, over);
  if (flows.keep_order)
    move_through_faces(state, run, flows);
  else
    mix_all(state, run, M, products);
  for (Int k = 0; k < n; ++k) {
    Cell& cell = state.cells[run[k]];
    const Int amount = clamp(M - k * ONE, 0, ONE) + clamp(over - (AMAX - ONE) * (n - 1 - k), 0, AMAX - ONE);
    if (flows.keep_order && cell.amount != amount)
      throw Violation("step " + std::to_string(state.step) + ": cell " + std::to_string(run[k]) +
                      " of a run in order holds " + std::to_string(cell.amount) + ", not " +
                      std::to_string(amount));
    cell.amount = amount;
    state.touch(run[k]);
    if (amount > 0) state.runs[run[k]] = shown;
  }
}

// What a non-blocked cell shows its neighbours, in a run or not. Outside runs `exposed` and `dead` are not
// used: only a cell in a run gives.
Run shown_by(const State& state, Int x, Int y, Int z) {
  const Run& own = state.runs[state.index(x, y, z)];
  if (own.member == 1) return own;
  Run shown;
  if (state.blocked(x, y - 1, z)) {
    shown.head = bed_of(state, x, y, z);
    shown.bed = shown.head;
    return shown;
  }
  const Run& below = state.runs[state.index(x, y - 1, z)];
  if (below.member == 1) {
    shown.head = below.head;
    shown.bed = below.bed;
    shown.mobility = below.mobility;
    return shown;
  }
  shown.head = 256 * (y - 2);
  return shown;
}

// slope[t] of section 11: floor((numerator + floor(q / 2)) / q).
constexpr Int slope(Int t, bool diagonal) {
  const Int root = 65536 + 256 * t * t + t * t * t * t;
  const Int q = diagonal ? root * root : 256 + 2 * t * t;
  const Int numerator = Int{1} << (diagonal ? 46 : 22);
  return (numerator + q / 2) / q;
}

// The same as the page lists it, from t = 0 on: first for an axis, then for a diagonal.
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

// t of section 11; `giver` and `taker` are what the cells of the pair show.
Int tilt(const Run& giver, const Run& taker) {
  if (!taker.bed.has_value()) return 0;
  const Int difference = (*giver.bed >> 4) - (*taker.bed >> 4);
  return smaller(16, larger(difference, -difference));
}

// What flows from the run cell i in a direction: the pair is computed once, by its giver.
void give(State& state, Int i, Place at, const Direction& direction, Int R) {
  if (!is_open(state, at, direction)) return;
  const Run& giver = state.runs[i];
  const Int x = at.x + direction.dx, z = at.z + direction.dz;
  const Int j = state.index(x, at.y, z);
  const Run taker = shown_by(state, x, at.y, z);
  const Int threshold = direction.diagonal ? (11 * giver.dead) >> 3 : giver.dead;
  const Int whole_drop = giver.head - taker.head;
  if (whole_drop <= 0 || whole_drop <= threshold) return;

  const Int drop = smaller(whole_drop, direction.diagonal ? 362 : 256);
  const Int drive = (slope(tilt(giver, taker), direction.diagonal) * drop) >> 9;
  const Int amount = state.cells[i].amount;
  const Int g = taker.member == 1 ? giver.mobility : giver.exposed;
  const Int c = smaller(65535, ((g + taker.mobility) * amount) >> 12);
  const Int w = direction.diagonal ? (c * drive + 16 * R) >> 20 : (c * drive + 4 * R) >> 18;
  const Int room = larger(0, (taker.member == 1 ? AMAX : ONE) - state.cells[j].amount);
  const Int f = smaller(w, smaller(amount >> 3, room >> 3));
  if (f == 0) return;
  state.touch(j);
  state.exchanges[i].given += f;
  state.exchanges[j].taken += f;
  state.exchanges[j].heat_taken += f * state.cells[i].heat;
}

}  // namespace

void settle(State& state) {
  for (const Int i : state.list) state.runs[i] = Run{};
  for (const Column& column : columns_with_liquid(state)) {
    for (Int y = column.low; y <= column.high; ++y) {
      const Int i = state.index(column.x, y, column.z);
      if (state.blocked(i) || state.cells[i].amount == 0) continue;
      if (!state.blocked(column.x, y - 1, column.z)) continue;
      const Int n = run_length(state, column.x, y, column.z);
      settle_run(state, column.x, y, column.z, n);
      y += n - 1;
    }
  }
  finish_phase(state, "after excess");
}

void spread_viscous(State& state) {
  const std::vector<Int> before = state.list;  // the list grows as cells take
  Int offsets[4] = {};
  for (Int axis = 0; axis < 4; ++axis) offsets[axis] = dither(state.step, axis, 4);
  for (const Int i : before) {
    if (state.runs[i].member == 0) continue;
    const Place at = state.place(i);
    for (const Direction& direction : DIRECTIONS) give(state, i, at, direction, offsets[direction.axis]);
  }
  move_exchanged(state);
  finish_phase(state, "after spread");
}

}  // namespace oracle
