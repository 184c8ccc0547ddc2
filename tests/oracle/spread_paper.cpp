// Spread under the paper law follows docs/automaton.md section 9.
#include "state.h"

#include <vector>

#include "random.h"

namespace oracle {
namespace {

struct Limits {
  Int cap, lim, most_share;
};

Limits limits_of(const PaperFlow& paper) {
  if (paper.neighbours == 8) return {ONE, 11 * ONE, 13107};
  return {2 * ONE, 8 * ONE, 16384};
}

// Returns sh, for a cell without a table.
Int share_of(const State& state, const Cell& cell) {
  const Parameters& parameters = state.parameters;
  if (!parameters.thermal_viscosity) return parameters.paper.share;
  const Int mobility = parameters.mobility_table[cell.heat >> 11];
  return smaller((parameters.paper.share * mobility) >> 15, limits_of(parameters.paper).most_share);
}

// Returns the pattern of a liquid cell: a set of directions, as a byte.
Int pattern_of(const State& state, const RandomBytes& random, const Cell& cell, Place at) {
  const PaperFlow& paper = state.parameters.paper;
  const Limits limits = limits_of(paper);
  if (paper.support && state.air(at.x, at.y - 1, at.z)) return 0;
  Int margin = 0;
  if (cell.energy > paper.threshold)
    margin = paper.margin;
  else if (paper.slump > 0)
    margin = paper.slump;
  else
    return 0;

  const Int F = paper.use_table ? 0 : smaller(scaled(cell.amount, share_of(state, cell)), limits.cap);
  const Int byte = random.byte(at.x, at.y, at.z, state.nx, state.ny, state.step);
  Int pattern = 0;
  for (Int d = 0; d < paper.neighbours; ++d) {
    if ((byte >> d) % 2 == 0 || !is_open(state, at, DIRECTIONS[d])) continue;
    const Int j = state.index(at.x + DIRECTIONS[d].dx, at.y, at.z + DIRECTIONS[d].dz);
    const Int amount = state.cells[j].amount;
    const Int G = DIRECTIONS[d].diagonal ? (9 * margin) >> 3 : margin;
    const bool lower = amount + larger(F, G) < cell.amount;
    if (amount < limits.lim && (!paper.downhill || lower)) pattern += Int{1} << d;
  }
  return pattern;
}

// Returns alpha of a cell, by what is below it.
Int alpha_of(const State& state, Place at) {
  const PaperFlow& paper = state.parameters.paper;
  if (at.y == 0) return paper.alpha_floor;
  const Cell& below = state.cells[state.index(at.x, at.y - 1, at.z)];
  if (below.inert == 1) return paper.alpha_floor;
  return below.solid == 1 ? paper.alpha_solid : paper.alpha_liquid;
}

void give(State& state, const RandomBytes& random, Int i) {
  const PaperFlow& paper = state.parameters.paper;
  const Cell& cell = state.cells[i];
  const Place at = state.place(i);
  const Int pattern = pattern_of(state, random, cell, at);
  if (pattern == 0) return;
  if (state.is_set(i)) {
    ++state.freeze_counts.kept;
    return;
  }
  const Int cap = limits_of(paper).cap;
  for (Int d = 0; d < paper.neighbours; ++d) {
    if ((pattern >> d) % 2 == 0) continue;
    const Direction& direction = DIRECTIONS[d];
    const Int share = paper.use_table ? paper.table[pattern][d] : share_of(state, cell);
    const auto part = [&](Int whole) {
      const Int f = smaller(scaled(whole, share), cap);
      return direction.diagonal ? f >> 2 : f;
    };
    const Int f = part(cell.amount);
    Int e = smaller(f, part(cell.energy));
    if (paper.printed) e = scaled(e, alpha_of(state, at));

    const Int j = state.index(at.x + direction.dx, at.y, at.z + direction.dz);
    state.touch(j);
    state.exchanges[i].given += f;
    state.exchanges[i].energy_given += e;
    state.exchanges[j].taken += f;
    state.exchanges[j].energy_taken += e;
    state.exchanges[j].heat_taken += f * cell.heat;
  }
}

void move_energy(State& state) {
  const PaperFlow& paper = state.parameters.paper;
  EnergyLedger& ledger = state.ledgers.energy;
  for (const Int i : state.list) {
    if (state.blocked(i)) continue;
    Cell& cell = state.cells[i];
    const Exchange& exchange = state.exchanges[i];
    Int gained = exchange.energy_taken;
    if (!paper.printed) gained = scaled(exchange.energy_taken, alpha_of(state, state.place(i)), state.offset);
    ledger.dissipated += exchange.energy_taken - gained;
    const Int energy = cell.energy - exchange.energy_given + gained;
    const Int amount = cell.amount - exchange.given + exchange.taken;
    cell.energy = smaller(energy, amount);
    ledger.capped += energy - cell.energy;
  }
}

}  // namespace

void move_exchanged(State& state) {
  for (const Int i : state.list) {
    if (state.blocked(i)) continue;
    Cell& cell = state.cells[i];
    Exchange& exchange = state.exchanges[i];
    const Int kept = cell.amount - exchange.given;
    cell.amount = kept + exchange.taken;
    if (state.parameters.heat.enabled && exchange.taken > 0) {
      const Int products = kept * cell.heat + exchange.heat_taken;
      cell.heat = mixed(products, cell.amount, state.mixture_offset);
      state.ledgers.heat.rounded += cell.amount * cell.heat - products;
    }
    exchange = Exchange{};
  }
}

void spread_paper(State& state) {
  const RandomBytes random(state.parameters.seed);
  const std::vector<Int> before = state.list;  // the list grows as cells take
  for (const Int i : before)
    if (state.cells[i].liquid == 1) give(state, random, i);
  move_energy(state);
  move_exchanged(state);
  finish_phase(state, "after spread");
}

}  // namespace oracle
