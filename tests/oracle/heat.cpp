// Heat follows docs/automaton.md section 6.
#include <vector>

#include "state.h"

namespace oracle {
namespace {

struct Axis {
  Int dx, dy, dz;
};
const std::vector<Axis> FACES = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<Axis> EDGES = {{1, 1, 0}, {1, -1, 0}, {1, 0, 1}, {1, 0, -1}, {0, 1, 1}, {0, 1, -1}};
const std::vector<Axis> CORNERS = {{1, 1, 1}, {1, 1, -1}, {1, -1, 1}, {1, -1, -1}};

// Returns T(h).
Int temperature(const State& state, Int i) {
  const Cell& cell = state.cells[i];
  return smaller(state.parameters.top, state.material(cell).unbound_temperature(cell.heat));
}

void count_bound_temperatures(State& state) {
  if (!state.parameters.several_materials) return;
  for (const Int i : state.list) {
    const Cell& cell = state.cells[i];
    if (state.matter(i) && state.material(cell).unbound_temperature(cell.heat) > state.parameters.top)
      ++state.material_counts.bound;
  }
}

// Adds the changes to the cells' heat and empties them.
void apply_changes(State& state, std::vector<Int>& changes, const char* name) {
  for (const Int i : state.list) {
    state.cells[i].heat += changes[i];
    changes[i] = 0;
    check_cell(state, i, name);
  }
}

// Returns the cell that is `steps` times the axis away from cell i, or -1 outside the grid.
Int neighbour(const State& state, Int i, const Axis& axis, Int steps) {
  const Place p = state.place(i);
  const Int x = p.x + steps * axis.dx, y = p.y + steps * axis.dy, z = p.z + steps * axis.dz;
  return state.inside(x, y, z) ? state.index(x, y, z) : -1;
}

using Weights = std::vector<Int> Material::*;

void conduct(State& state, const std::vector<Axis>& axes, Weights weights, std::vector<Int>& changes) {
  const Int n = static_cast<Int>(axes.size());
  std::vector<Int> offsets;
  for (Int k = 0; k < n; ++k) offsets.push_back(dither(state.step, k, n));
  HeatLedger& ledger = state.ledgers.heat;
  MaterialCounts& counts = state.material_counts;
  for (const Int i : state.list) {
    if (!state.matter(i)) continue;
    const Int amount = state.cells[i].amount;
    const Int own = state.cells[i].material;
    const std::vector<Int>& weights_of_cell = state.parameters.materials[own].*weights;
    for (Int k = 0; k < n; ++k) {
      // This is F of the pair p, q = p + axis k.
      const auto flow = [&](Int p, Int q, Int weight) {
        return scaled(temperature(state, q) - temperature(state, p), weight, offsets[k]);
      };
      const Int ahead = neighbour(state, i, axes[k], 1), behind = neighbour(state, i, axes[k], -1);
      if (ahead >= 0 && state.matter(ahead)) {
        const Int other = state.cells[ahead].material;
        const Int F = flow(i, ahead, weights_of_cell[other]);
        if (other != own && F != 0) ++counts.pairs;
        changes[i] += F;
        changes[ahead] -= F;
        ledger.conducted += (amount - state.cells[ahead].amount) * F;
      }
      // A wall is of the cell's material here.
      const Int to_wall = weights_of_cell[own];
      Int from_walls = 0;
      if (ahead >= 0 && state.isothermal_wall(ahead)) from_walls += flow(i, ahead, to_wall);
      if (behind >= 0 && state.isothermal_wall(behind)) from_walls -= flow(behind, i, to_wall);
      if (own != 0 && from_walls != 0) ++counts.walls;
      changes[i] += from_walls;
      ledger.walls += amount * from_walls;
    }
  }
  apply_changes(state, changes, "after a pass of conduction");
}

void convect(State& state, std::vector<Int>& changes) {
  for (const Int i : state.list) {
    const Place p = state.place(i);
    if (state.cells[i].liquid == 0 || p.y + 1 == state.ny) continue;
    const Int above = state.index(p.x, p.y + 1, p.z);
    if (state.cells[above].liquid == 0) continue;
    const Int difference = temperature(state, i) - temperature(state, above);
    if (difference <= 0) continue;
    const Int flow = scaled(difference, state.parameters.heat.convection, state.offset);
    changes[i] -= flow;
    changes[above] += flow;
    state.ledgers.heat.convected += (state.cells[above].amount - state.cells[i].amount) * flow;
  }
  apply_changes(state, changes, "after convection");
}

void radiate(State& state) {
  for (const Int i : state.list) {
    Cell& cell = state.cells[i];
    if (cell.solid == 0) continue;
    const Int gained = smaller((4096 * state.irradiance[i] + state.offset) >> 16, 65535 - cell.heat);
    cell.heat += gained;
    state.ledgers.heat.radiated += cell.amount * gained;
    check_cell(state, i, "after radiation");
  }
}

// Returns the number of axes on which at least one of the two face neighbours is air.
Int airy_axes(const State& state, Place p) {
  Int n = 0;
  if (state.air(p.x - 1, p.y, p.z) || state.air(p.x + 1, p.y, p.z)) ++n;
  if (state.air(p.x, p.y - 1, p.z) || state.air(p.x, p.y + 1, p.z)) ++n;
  if (state.air(p.x, p.y, p.z - 1) || state.air(p.x, p.y, p.z + 1)) ++n;
  return n;
}

// Lets each cell of matter beside air gain scaled(difference(its place, its T), w). w is rate(the cell) by
// the area that air sees.
template <typename Rate, typename Difference>
void gain_through_surface(State& state, Rate rate, Difference difference, const char* name) {
  for (const Int i : state.list) {
    if (!state.matter(i)) continue;
    const Place p = state.place(i);
    const Int n = airy_axes(state, p);
    if (n == 0) continue;
    Cell& cell = state.cells[i];
    const Int w = (rate(cell) * (3 + n)) >> 2;
    const Int wanted = scaled(difference(p, temperature(state, i)), w, state.offset);
    const Int gained = smaller(wanted, 65535 - cell.heat);
    cell.heat += gained;
    if (cell.material != 0 && gained != 0) ++state.material_counts.aired;
    if (gained > 0) state.ledgers.heat.warmed += cell.amount * gained;
    if (gained < 0) state.ledgers.heat.cooled -= cell.amount * gained;
    check_cell(state, i, name);
  }
}

void exchange_with_air(State& state) {
  const Heat& rules = state.parameters.heat;
  const auto difference = [&](Place p, Int T) { return rules.air_temperature[p.y] - T; };
  const auto rate = [&](const Cell& cell) { return state.material(cell).air_exchange; };
  gain_through_surface(state, rate, difference, "after the exchange with air");
}

// Returns q(t), which goes with the fourth power of a temperature.
constexpr Int fourth_power(Int t) {
  const Int square = (t * t) >> 16;
  return (square * square) >> 16;
}

void glow(State& state) {
  const Heat& rules = state.parameters.heat;
  const Int sky = fourth_power(rules.air_sky);
  const auto difference = [&](Place, Int T) { return sky - fourth_power(T); };
  const auto rate = [&](const Cell&) { return rules.air_glow; };
  gain_through_surface(state, rate, difference, "after glow");
}

}  // namespace

void heat(State& state) {
  const Heat& rules = state.parameters.heat;
  if (!rules.enabled) return;
  std::vector<Int> changes(state.cells.size(), 0);
  count_bound_temperatures(state);
  conduct(state, FACES, &Material::weight_face, changes);
  if (rules.neighbours >= 18) conduct(state, EDGES, &Material::weight_edge, changes);
  if (rules.neighbours == 26) conduct(state, CORNERS, &Material::weight_corner, changes);
  if (rules.convection > 0) convect(state, changes);
  if (rules.radiation) radiate(state);
  if (rules.air) exchange_with_air(state);
  if (rules.air && rules.air_glow > 0) glow(state);
  finish_phase(state, "after heat");
}

}  // namespace oracle
