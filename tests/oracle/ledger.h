// There are three ledgers (docs/automaton.md section 12).
#pragma once
#include "arithmetic.h"

#include <string>

namespace oracle {

struct State;

struct MassLedger {
  Sum start = 0, added = 0, removed = 0, held = 0;
  bool balances() const { return start + added - removed == held; }
};

struct EnergyLedger {
  Sum start = 0, melted = 0, frozen = 0, added = 0, removed = 0, reheated = 0;
  Sum accelerated = 0, dissipated = 0, capped = 0, held = 0;
  bool balances() const {
    return start + melted - frozen + added - removed + reheated + accelerated - dissipated - capped == held;
  }
};

struct HeatLedger {
  Sum start = 0, conducted = 0, walls = 0, convected = 0, radiated = 0, warmed = 0, cooled = 0;
  Sum melted = 0, added = 0, removed = 0, rounded = 0, held = 0;
  bool balances() const {
    return start + conducted + walls + convected + radiated + warmed - cooled + melted + added - removed +
               rounded ==
           held;
  }
};

struct Ledgers {
  MassLedger mass;
  EnergyLedger energy;
  HeatLedger heat;
};

// Counts, over all settles, the cells in runs and their mass, and those of them that a limit holds back
// (section 10).
struct Counters {
  Sum cells = 0, mass = 0, limited_cells = 0, limited_mass = 0;
};

// Counts the pairs whose heads relaxed, those of them that let liquid flow back, and pairs that would give if
// they were not shut (section 11).
struct PairCounts {
  Sum relaxed = 0, back = 0, shut = 0;
};

// Counts how often a loose piece that does not wade moved, how often one that wades did, and how often one
// stayed because it floats, at a step that `in_liquid` divides (section 15).
struct PieceCounts {
  Sum falls = 0, wades = 0, floats = 0;
};

// Counts the cells that froze, those that were set, the pairs of cells or the cells that would give or fall
// if they were not set, the pairs that would flow back, and frozen cells that melted (section 7).
struct FreezeCounts {
  Sum frozen = 0, set = 0, kept = 0, hung = 0, not_back = 0, melted_again = 0;
};

// Counts what happens to materials other than 0 (sections 6, 7, 10 and 15): flows between cells of two
// materials, and between such a solid and a wall; solids and liquids whose temperature is that of `top`, when
// conduction begins; what melts, by its heat: that rises, stays, falls or is cut at 65535; runs on the bed of
// such a solid, and of one that is partly molten; such cells in pieces that move; and such that air or glow
// warms or cools.
struct MaterialCounts {
  Sum pairs = 0, walls = 0, bound = 0;
  Sum raised = 0, kept = 0, lowered = 0, cut = 0;
  Sum beds = 0, molten_beds = 0, moved = 0, aired = 0;
};

void open_ledgers(State& state);   // sets start
void close_ledgers(State& state);  // sets held
std::string ledger_lines(const Ledgers& ledgers);
std::string counters_line(const Counters& counters);
std::string pairs_line(const PairCounts& counts);
std::string pieces_line(const PieceCounts& counts);
std::string freeze_line(const FreezeCounts& counts);
std::string materials_line(const MaterialCounts& counts);
Sum mass_held(const State& state);

}  // namespace oracle
