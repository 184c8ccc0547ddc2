// The state is that of docs/automaton.md section 1, with the data that a step keeps beside it.
#pragma once
#include "ledger.h"
#include "parameters.h"

#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace oracle {

// Reports a broken invariant (section 1), bound (docs/proofs.md) or ledger (section 12).
struct Violation : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Cell {
  Int solid = 0, inert = 0, liquid = 0;
  Int amount = 0, energy = 0, heat = 0;
  Int material = 0;  // m
};

// Holds what a cell gives and takes in one spread (sections 9 and 11).
struct Exchange {
  Int given = 0, taken = 0;
  Int energy_given = 0, energy_taken = 0;
  Int heat_taken = 0;  // sum of f_in h_j
};

// Holds what a cell in a run shows its neighbours (section 10).
struct Run {
  Int member = 0;     // 1: the cell is in a run
  Int cells = 0;      // how many are in the run
  bool shut = false;  // the run is full, and has a ceiling
  std::optional<Int> bed;
  std::optional<Int> limit;  // in 1/2^(16 - bits)
  bool limited = false;      // raw is above it
  Int head = 0, dead = 0;
  Int mobility = 0;  // between runs, in 1/2^24
  Int exposed = 0;   // towards cells outside runs, in 1/2^24
};

// The stages of a sub-step (section 10).
struct Stages {
  Int S = 1, reach = 1, bits = 0;
};

struct Place {
  Int x, y, z;
};

struct State {
  Int nx = 0, ny = 0, nz = 0;
  Int step = 0;                   // s: the steps done, and the number of the step that runs
  Int offset = 0;                 // D(s)
  Int mixture_offset = 0;         // B
  Int substep = 0, substeps = 1;  // u and K of section 3, under the viscous law
  Stages stages;
  Parameters parameters;
  std::vector<Cell> cells;
  std::vector<Int> irradiance;  // section 5, kept between its steps
  // Section 7: the last step in which the cell's solid melted, its liquid froze, it was set; -1: in none.
  std::vector<Int> melted_in, frozen_in, set_in;
  std::vector<Run> runs;
  std::vector<Exchange> exchanges;
  Ledgers ledgers;
  Counters counters;
  PairCounts pair_counts;
  PieceCounts piece_counts;
  FreezeCounts freeze_counts;
  MaterialCounts material_counts;

  // The list has all cells of matter, and some that have lost theirs. The others are empty or inert.
  std::vector<Int> list;
  std::vector<Int> listed;

  Int index(Int x, Int y, Int z) const { return (z * ny + y) * nx + x; }
  Place place(Int i) const { return {i % nx, i / nx % ny, i / nx / ny}; }
  bool inside(Int x, Int y, Int z) const { return x >= 0 && x < nx && y >= 0 && y < ny && z >= 0 && z < nz; }
  bool matter(Int i) const { return cells[i].solid == 1 || cells[i].liquid == 1; }
  bool blocked(Int i) const { return cells[i].solid == 1 || cells[i].inert == 1; }

  bool isothermal_wall(Int i) const { return cells[i].inert == 1 && cells[i].heat > 0; }

  // The border is inert (section 1): blocked, never air.
  bool blocked(Int x, Int y, Int z) const { return !inside(x, y, z) || blocked(index(x, y, z)); }
  bool air(Int x, Int y, Int z) const { return !blocked(x, y, z) && cells[index(x, y, z)].liquid == 0; }
  const Material& material(const Cell& cell) const { return parameters.materials[cell.material]; }
  bool is_set(Int i) const { return set_in[i] == step; }
  // Under the paper law sides date from before melt (section 8): a side that melted in this very step still
  // counts, and one that froze in it does not yet.
  bool wall(Int x, Int y, Int z) const {
    if (!inside(x, y, z) || !parameters.paper_law) return blocked(x, y, z);
    const Int i = index(x, y, z);
    return melted_in[i] == step || (blocked(i) && frozen_in[i] != step);
  }
  bool beside_wall(Place p) const {
    return wall(p.x + 1, p.y, p.z) || wall(p.x - 1, p.y, p.z) || wall(p.x, p.y, p.z + 1) ||
           wall(p.x, p.y, p.z - 1);
  }

  void touch(Int i) {
    if (listed[i] == 1) return;
    listed[i] = 1;
    list.push_back(i);
  }
};

// There are eight horizontal directions (section 2). The last four are diagonals.
struct Direction {
  Int dx, dz;
  bool diagonal;
  Int axis;  // section 11: 0: x, 1: z, 2 and 3: the diagonals
};
constexpr Direction DIRECTIONS[8] = {
    {1, 0, false, 0}, {-1, 0, false, 0}, {0, 1, false, 1}, {0, -1, false, 1},
    {1, 1, true, 2},  {1, -1, true, 3},  {-1, 1, true, 3}, {-1, -1, true, 2},
};
bool is_open(const State& state, Place from, const Direction& d);  // section 2

// These are in state.cpp.
State read_state(const std::string& folder);
void write_fields(const State& state, const std::string& folder);
void finish_phase(State& state, const char* name);             // section 3, last sentence
void check_cell(const State& state, Int i, const char* when);  // section 1, docs/proofs.md
void check_all(const State& state, const char* when);
void forget_empty_cells(State& state);
// Sets the receiver's heat, once it has f > 0 of the giver too (section 2). It is called before the amounts
// change.
void mix_heat(State& state, Cell& receiver, const Cell& giver, Int f);

// Names a column that holds liquid, with its lowest and highest liquid cell.
struct Column {
  Int x, z, low, high;
};
std::vector<Column> columns_with_liquid(const State& state);

// These are the phases of section 3.
void pieces_fall(State& state);                         // section 15
void find_irradiance(State& state);                     // section 5
void source(State& state);                              // section 4
void heat(State& state);                                // section 6
void melt(State& state);                                // section 7
void gravity(State& state);                             // section 8
void spread_paper(State& state);                        // section 9
void count_substeps(State& state);                      // sections 3 and 10: K and the stages
Run shown_by(const State& state, Int x, Int y, Int z);  // section 10: by a cell that is not blocked
void settle(State& state);                              // section 10
void spread_viscous(State& state);                      // section 11
void move_exchanged(State& state);                      // sections 9 and 11: A' and h'
void run_step(State& state);                            // section 3

std::uint64_t digest(const State& state);  // section 13

}  // namespace oracle
