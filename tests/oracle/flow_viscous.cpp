// docs/automaton.md sections 10 (settle) and 11 (spread), viscous law.
#include <vector>

#include "state.h"

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

// Settles the run of n cells that starts at y0.
void settle_run(State& state, Int x, Int y0, Int z, Int n) {
  Int M = 0;
  Sum products = 0;
  for (Int k = 0; k < n; ++k) {
    const Cell& cell = state.cells[state.index(x, y0 + k, z)];
    M += cell.amount;
    products += cell.amount * cell.heat;
  }
  Int h = 0;
  if (state.parameters.heat.enabled) {
    h = mixed(static_cast<Int>(products), M, state.offset);
    state.ledgers.heat.rounded += Sum{M} * h - products;
  }
  const Int over = larger(0, M - n * ONE);
  const Run run = shown_by_run(state.parameters, bed_of(state, x, y0, z), M, over, h);
  for (Int k = 0; k < n; ++k) {
    const Int i = state.index(x, y0 + k, z);
    Cell& cell = state.cells[i];
    cell.amount = clamp(M - k * ONE, 0, ONE) + clamp(over - (AMAX - ONE) * (n - 1 - k), 0, AMAX - ONE);
    cell.heat = h;
    state.touch(i);
    if (cell.amount > 0) state.runs[i] = run;
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
    return shown;
  }
  const Run& below = state.runs[state.index(x, y - 1, z)];
  if (below.member == 1) {
    shown.head = below.head;
    shown.mobility = below.mobility;
    return shown;
  }
  shown.head = 256 * (y - 2);
  return shown;
}

// What flows from the run cell i in a direction: the pair is computed once, by its giver.
void give(State& state, Int i, Place at, const Direction& direction, Int R) {
  if (!is_open(state, at, direction)) return;
  const Run& giver = state.runs[i];
  const Int x = at.x + direction.dx, z = at.z + direction.dz;
  const Int j = state.index(x, at.y, z);
  const Run taker = shown_by(state, x, at.y, z);
  const Int threshold = direction.diagonal ? (11 * giver.dead) >> 3 : giver.dead;
  Int drop = giver.head - taker.head;
  if (drop <= 0 || drop <= threshold) return;

  const Int amount = state.cells[i].amount;
  const Int g = taker.member == 1 ? giver.mobility : giver.exposed;
  const Int c = smaller(65535, ((g + taker.mobility) * amount) >> 12);
  Int w = 0;
  if (direction.diagonal)
    w = (c * smaller(drop, 362) + (R >> 1)) >> 15;
  else
    w = (c * smaller(drop, 256) + (R >> 3)) >> 13;
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
