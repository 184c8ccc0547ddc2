// Gravity and, under the paper law, excess run in one sweep per column (docs/automaton.md section 8).
#include "state.h"

namespace oracle {
namespace {

// Returns what cell q, at `at`, is ready to let fall into p. Both have the amounts of the moment.
Int ready_to_fall(State& state, const Cell& p, const Cell& q, Place at) {
  const Fall& fall = state.parameters.fall;
  const bool wall = state.beside_wall(at);
  const bool touches = wall || state.blocked(at.x, at.y + 1, at.z);
  if (state.is_set(state.index(at.x, at.y, at.z)) && touches) {
    ++state.freeze_counts.hung;
    return 0;
  }
  if (fall.hang > 0 && q.amount < fall.hang && p.amount == 0 && touches) return 0;
  const Int g = wall ? fall.wall_factor : fall.factor;
  return smaller(q.amount, ((q.amount * g) >> 16) + fall.minimum);
}

void move_down(State& state, Cell& p, Cell& q, Int f) {
  const PaperFlow& paper = state.parameters.paper;
  EnergyLedger& ledger = state.ledgers.energy;
  if (f == 0) return;
  mix_heat(state, p, q, f);
  if (state.parameters.paper_law) {
    const Int m = smaller(q.energy, f);
    const Int b = (m * paper.beta) >> 16;
    const Int room = p.amount + f - p.energy;
    const Int gained = paper.printed ? smaller(smaller(b, q.energy), room) : smaller(b, room);
    const Int lost = paper.printed ? gained : m;
    p.energy += gained;
    q.energy -= lost;
    ledger.accelerated += gained - lost;
    const Int kept = smaller(q.energy, q.amount - f);
    ledger.capped += q.energy - kept;
    q.energy = kept;
  }
  q.amount -= f;
  p.amount += f;
}

void move_up(State& state, Cell& p, Cell& q) {
  const Int f = smaller(p.amount - ONE, AMAX - q.amount);
  if (f == 0) return;
  const Int energy = smaller(p.energy, f);
  mix_heat(state, q, p, f);
  p.energy -= energy;
  q.energy += energy;
  p.amount -= f;
  q.amount += f;
}

void sweep(State& state, const Column& column) {
  const bool paper_law = state.parameters.paper_law;
  for (Int y = larger(0, column.low - 1); y + 1 < state.ny; ++y) {
    const Int below = state.index(column.x, y, column.z);
    const Int above = state.index(column.x, y + 1, column.z);
    // Above the highest liquid only excess still climbs.
    if (y >= column.high && (state.blocked(below) || state.cells[below].amount <= ONE)) break;
    if (state.blocked(below) || state.blocked(above)) continue;
    Cell& p = state.cells[below];
    Cell& q = state.cells[above];
    if (q.amount > 0 && p.amount < ONE && (paper_law || state.runs[above].member == 0)) {
      const Int ready = ready_to_fall(state, p, q, {column.x, y + 1, column.z});
      move_down(state, p, q, smaller(ready, ONE - p.amount));
    } else if (paper_law && p.amount > ONE) {
      move_up(state, p, q);
    }
    state.touch(below);
    state.touch(above);
  }
}

}  // namespace

void gravity(State& state) {
  for (const Column& column : columns_with_liquid(state)) sweep(state, column);
  finish_phase(state, "after gravity");
}

}  // namespace oracle
