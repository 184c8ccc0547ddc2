// A pair gives, and its heads relax, as docs/automaton.md section 11 says.
#pragma once
#include "state.h"

#include <vector>

namespace oracle {

// Holds a pair whose giver i has a head that is higher by more than z. Not both of its cells are shut.
struct Pair {
  Int i = 0, j = 0;
  Direction direction{};      // from i to j
  bool between_runs = false;  // j is in a run, too
  Int drop = 0;               // of the heads, in 1/512 cell
  Int s = 0, c = 0;
};

// Returns floor(2^(15 + bits) / reach).
constexpr Int scale_of(const Stages& stages) { return (Int{1} << (15 + stages.bits)) / stages.reach; }

// Returns I_S of i less that of j of each pair between runs, in 1/32768 cell, and 0 for the others.
std::vector<Int> relaxed_drops(const State& state, const std::vector<Pair>& pairs);

}  // namespace oracle
