// Vents, drains and an open border follow docs/automaton.md section 4.
#include <cstddef>

#include "state.h"

namespace oracle {
namespace {

void fill(State& state, const Region& vent, Int i) {
  Cell& cell = state.cells[i];
  const Int f = smaller(vent.rate, AMAX - cell.amount);
  if (f == 0) return;
  const Int before = cell.amount;
  cell.amount += f;
  state.ledgers.mass.added += f;
  if (state.parameters.paper_law) {
    const Int gained = (f * vent.energy) >> 12;
    cell.energy += gained;
    state.ledgers.energy.added += gained;
  }
  if (state.parameters.heat.enabled) {
    const Int products = before * cell.heat + f * vent.temperature;
    cell.heat = mixed(products, cell.amount, state.mixture_offset);
    state.ledgers.heat.added += f * vent.temperature;
    state.ledgers.heat.rounded += cell.amount * cell.heat - products;
  }
  state.touch(i);
}

void take(State& state, Int rate, Int i) {
  Cell& cell = state.cells[i];
  const Int f = smaller(rate, cell.amount);
  cell.amount -= f;
  state.ledgers.mass.removed += f;
  state.ledgers.heat.removed += f * cell.heat;
  const Int energy = smaller(cell.energy, cell.amount);
  state.ledgers.energy.removed += cell.energy - energy;
  cell.energy = energy;
}

void empty(State& state, const Region& drain, Int i) { take(state, drain.rate, i); }

void empty_border(State& state) {
  for (Int z = 0; z < state.nz; ++z)
    for (Int y = 0; y < state.ny; ++y)
      for (Int x = 0; x < state.nx; ++x) {
        const bool border = x == 0 || x == state.nx - 1 || z == 0 || z == state.nz - 1;
        if (border && !state.blocked(x, y, z)) take(state, AMAX, state.index(x, y, z));
      }
}

template <typename Action>
void act(State& state, const Region& region, Action action) {
  if (state.step < region.from || state.step >= region.until) return;
  const auto first = [&](std::size_t axis) {
    return larger(0, floor_divide<Int>(region.at[axis] - region.radius, 16));
  };
  const auto last = [&](std::size_t axis, Int size) {
    return smaller(size - 1, floor_divide<Int>(region.at[axis] + region.radius, 16));
  };
  for (Int z = first(2); z <= last(2, state.nz); ++z)
    for (Int y = first(1); y <= last(1, state.ny); ++y)
      for (Int x = first(0); x <= last(0, state.nx); ++x) {
        const Int dx = 16 * x + 8 - region.at[0];
        const Int dy = 16 * y + 8 - region.at[1];
        const Int dz = 16 * z + 8 - region.at[2];
        if (dx * dx + dy * dy + dz * dz > region.radius * region.radius) continue;
        if (!state.blocked(x, y, z)) action(state, region, state.index(x, y, z));
      }
}

}  // namespace

void source(State& state) {
  for (const Region& vent : state.parameters.vents) act(state, vent, fill);
  for (const Region& drain : state.parameters.drains) act(state, drain, empty);
  if (state.parameters.open_border) empty_border(state);
  finish_phase(state, "after source");
}

}  // namespace oracle
