// Melting, freezing and setting follow docs/automaton.md section 7.
#include "state.h"

#include <vector>

namespace oracle {
namespace {

constexpr Int FREEZES_FROM = ONE - ONE / 64;

bool beside_blocked(const State& state, Place p) {
  return state.blocked(p.x - 1, p.y, p.z) || state.blocked(p.x + 1, p.y, p.z) ||
         state.blocked(p.x, p.y - 1, p.z) || state.blocked(p.x, p.y + 1, p.z) ||
         state.blocked(p.x, p.y, p.z - 1) || state.blocked(p.x, p.y, p.z + 1);
}

// Marks the cells that are set in this step, and returns those that freeze. The masks are still those of the
// phase's begin.
std::vector<Int> set_and_find_freezing(State& state) {
  std::vector<Int> freezing;
  for (const Int i : state.list) {
    const Cell& cell = state.cells[i];
    if (cell.liquid == 0 || cell.heat >= state.parameters.freezing_point) continue;
    if (cell.amount >= FREEZES_FROM && beside_blocked(state, state.place(i))) {
      freezing.push_back(i);
    } else {
      state.set_in[i] = state.step;
      ++state.freeze_counts.set;
    }
  }
  return freezing;
}

void freeze(State& state, Int i) {
  Cell& cell = state.cells[i];
  cell.liquid = 0;
  cell.solid = 1;
  state.ledgers.energy.frozen += cell.energy;
  cell.energy = 0;
  state.frozen_in[i] = state.step;
  ++state.freeze_counts.frozen;
}

// Lets what melts go on at its temperature as material 0 does.
void become_material_0(State& state, Cell& cell) {
  const Material& own = state.material(cell);
  const Material& other = state.parameters.materials[0];
  const bool lower = own.melting_point <= other.melting_point;
  const Int H = lower ? own.melting_point : own.melting_point + other.latent_heat;
  const Int wanted = cell.heat - own.F + H;
  const Int h = smaller(65535, wanted);
  MaterialCounts& counts = state.material_counts;
  if (wanted > h) ++counts.cut;
  ++(h > cell.heat ? counts.raised : h < cell.heat ? counts.lowered : counts.kept);
  state.ledgers.heat.melted += cell.amount * (h - cell.heat);
  cell.heat = h;
  cell.material = 0;
}

void melt_solid(State& state, Int i) {
  Cell& cell = state.cells[i];
  if (cell.material != 0) become_material_0(state, cell);
  cell.solid = 0;
  cell.liquid = 1;
  state.melted_in[i] = state.step;
  if (state.frozen_in[i] >= 0) ++state.freeze_counts.melted_again;
  if (!state.parameters.paper_law) return;
  cell.energy = cell.amount;
  state.ledgers.energy.melted += cell.amount;
}

void reheat(State& state, Cell& cell) {
  const Int gained = scaled(cell.amount - cell.energy, state.parameters.paper.reheat);
  cell.energy += gained;
  state.ledgers.energy.reheated += gained;
}

}  // namespace

void melt(State& state) {
  const Parameters& parameters = state.parameters;
  if (!parameters.heat.enabled) return;
  const std::vector<Int> freezing = set_and_find_freezing(state);
  for (const Int i : state.list) {
    Cell& cell = state.cells[i];
    if (!state.matter(i) || cell.heat < state.material(cell).F) continue;
    if (cell.solid == 1)
      melt_solid(state, i);
    else if (parameters.paper_law && parameters.paper.reheat > 0)
      reheat(state, cell);
  }
  for (const Int i : freezing) freeze(state, i);
  finish_phase(state, "after melt");
}

}  // namespace oracle
