// The state follows docs/automaton.md sections 1, 2 (open neighbours) and 3 (end of a phase), and
// docs/proofs.md (bounds).
#include "state.h"

#include "npy.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oracle {

State read_state(const std::string& folder) {
  State state;
  state.parameters = read_parameters(folder + "/parameters.json");
  state.step = state.parameters.step;
  state.nx = state.parameters.grid[0];
  state.ny = state.parameters.grid[1];
  state.nz = state.parameters.grid[2];
  const Int count = state.nx * state.ny * state.nz;
  const std::array<Int, 3> shape = {state.nz, state.ny, state.nx};
  state.cells.resize(count);

  struct Field {
    const char* name;
    Int width;
    Int Cell::*member;
  };
  const Field fields[] = {{"solid", 1, &Cell::solid},   {"liquid", 1, &Cell::liquid},
                          {"inert", 1, &Cell::inert},   {"amount", 2, &Cell::amount},
                          {"energy", 2, &Cell::energy}, {"heat", 2, &Cell::heat}};
  const auto read = [&](const Field& field) {
    const std::vector<Int> values = read_npy(folder + "/" + field.name + ".npy", shape, field.width);
    for (Int i = 0; i < count; ++i) state.cells[i].*field.member = values[i];
  };
  for (const Field& field : fields) read(field);
  if (state.parameters.several_materials) read({"material", 1, &Cell::material});

  state.irradiance.resize(count);
  for (std::vector<Int>* steps : {&state.melted_in, &state.frozen_in, &state.set_in})
    steps->resize(count, -1);
  state.runs.resize(count);
  state.exchanges.resize(count);
  state.listed.resize(count);
  check_all(state, "at the start");
  bool walls = false;
  for (Int i = 0; i < count; ++i) {
    if (state.matter(i)) state.touch(i);
    walls = walls || state.isothermal_wall(i);
  }
  if (walls != state.parameters.heat.walls) throw Violation("heat.walls, but no isothermal wall");
  open_ledgers(state);
  return state;
}

void write_fields(const State& state, const std::string& folder) {
  const std::array<Int, 3> shape = {state.nz, state.ny, state.nx};
  const auto write = [&](const char* name, Int width, Int Cell::*member) {
    std::vector<Int> values;
    for (const Cell& cell : state.cells) values.push_back(cell.*member);
    write_npy(folder + "/" + name + ".npy", shape, width, values);
  };
  write("solid", 1, &Cell::solid);
  write("liquid", 1, &Cell::liquid);
  write("inert", 1, &Cell::inert);
  write("amount", 2, &Cell::amount);
  write("energy", 2, &Cell::energy);
  write("heat", 2, &Cell::heat);
  if (state.parameters.several_materials) write("material", 1, &Cell::material);
}

bool is_open(const State& state, Place from, const Direction& d) {
  if (state.blocked(from.x + d.dx, from.y, from.z + d.dz)) return false;
  return !d.diagonal || !state.blocked(from.x + d.dx, from.y, from.z) ||
         !state.blocked(from.x, from.y, from.z + d.dz);
}

void check_cell(const State& state, Int i, const char* when) {
  const Cell& cell = state.cells[i];
  const bool matter = cell.solid == 1 || cell.liquid == 1;
  const char* wrong = nullptr;
  if (cell.solid < 0 || cell.solid > 1 || cell.inert < 0 || cell.inert > 1 || cell.liquid < 0 ||
      cell.liquid > 1)
    wrong = "a mask is neither 0 nor 1";
  else if (cell.solid + cell.inert + cell.liquid > 1)
    wrong = "more than one of solid, inert, liquid";
  else if (cell.amount < 0 || cell.amount > AMAX)
    wrong = "amount outside 0..AMAX";
  else if (cell.heat < 0 || cell.heat > 65535)
    wrong = "heat outside 0..65535";
  else if (cell.energy < 0 || cell.energy > cell.amount)
    wrong = "energy outside 0..amount";
  else if (cell.solid == 1 && cell.amount == 0)
    wrong = "a solid without amount";
  else if (cell.solid == 1 && cell.energy != 0)
    wrong = "energy in a solid";
  else if (!matter && cell.energy != 0)
    wrong = "energy without matter";
  else if (!matter && cell.inert == 0 && cell.heat != 0)
    wrong = "heat in air";
  else if (cell.amount == 0 && cell.heat != 0)
    wrong = "heat without amount";
  else if (cell.solid == 0 && cell.inert == 0 && cell.liquid != (cell.amount > 0 ? 1 : 0))
    wrong = "liquid is not amount > 0";
  else if (!state.parameters.paper_law && cell.energy != 0)
    wrong = "energy under the viscous law";
  else if (!state.parameters.heat.enabled && cell.heat != 0)
    wrong = "heat without heat.enabled";
  else if (!state.parameters.heat.walls && state.isothermal_wall(i))
    wrong = "an isothermal wall without heat.walls";
  else if (cell.material < 0 || cell.material >= static_cast<Int>(state.parameters.materials.size()))
    wrong = "a material that is not there";
  else if (cell.solid == 0 && cell.material != 0)
    wrong = "a material of its own in what is not solid";
  if (wrong == nullptr) return;
  const Place p = state.place(i);
  throw Violation("step " + std::to_string(state.step) + ", " + when + ": cell (" + std::to_string(p.x) +
                  ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + "): " + wrong + " (solid " +
                  std::to_string(cell.solid) + " inert " + std::to_string(cell.inert) + " liquid " +
                  std::to_string(cell.liquid) + " amount " + std::to_string(cell.amount) + " energy " +
                  std::to_string(cell.energy) + " heat " + std::to_string(cell.heat) + " material " +
                  std::to_string(cell.material) + ")");
}

void check_all(const State& state, const char* when) {
  for (Int i = 0; i < static_cast<Int>(state.cells.size()); ++i) check_cell(state, i, when);
}

void finish_phase(State& state, const char* name) {
  for (const Int i : state.list) {
    Cell& cell = state.cells[i];
    if (!state.blocked(i)) {
      cell.liquid = cell.amount > 0 ? 1 : 0;
      if (cell.amount == 0 && cell.energy == 0) cell.heat = 0;  // energy > amount is left for the check
    }
    check_cell(state, i, name);
  }
}

void mix_heat(State& state, Cell& receiver, const Cell& giver, Int f) {
  if (!state.parameters.heat.enabled) return;
  const Int products = receiver.amount * receiver.heat + f * giver.heat;
  const Int amount = receiver.amount + f;
  receiver.heat = mixed(products, amount, state.mixture_offset);
  state.ledgers.heat.rounded += amount * receiver.heat - products;
}

void forget_empty_cells(State& state) {
  std::vector<Int> kept;
  for (const Int i : state.list) {
    if (state.matter(i)) {
      kept.push_back(i);
    } else {
      state.listed[i] = 0;
      state.runs[i] = Run{};
      state.exchanges[i] = Exchange{};
    }
  }
  if (!std::is_sorted(kept.begin(), kept.end())) std::sort(kept.begin(), kept.end());
  state.list = std::move(kept);
}

std::vector<Column> columns_with_liquid(const State& state) {
  std::vector<Column> columns;
  std::vector<Int> number(state.nx * state.nz, -1);
  for (const Int i : state.list) {
    if (state.cells[i].liquid == 0) continue;
    const Place p = state.place(i);
    Int& n = number[p.z * state.nx + p.x];
    if (n < 0) {
      n = static_cast<Int>(columns.size());
      columns.push_back({p.x, p.z, p.y, p.y});
    }
    columns[n].low = smaller(columns[n].low, p.y);
    columns[n].high = larger(columns[n].high, p.y);
  }
  return columns;
}

}  // namespace oracle
