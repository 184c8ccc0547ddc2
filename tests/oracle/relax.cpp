// Heads relax in stages as docs/automaton.md section 11, "Relaxed heads", says.
#include "pair.h"

#include <cstddef>
#include <utility>
#include <vector>

namespace oracle {
namespace {

// Holds a cell of a pair between runs: its head above 512 (y - 2), and W, D and I after a stage.
struct Level {
  Int head = 0;
  Int W = 0, D = 0, I = 0;
  Int taken = 0, given = 0;
};

// Holds the numbers of the levels of i and j, and k.
struct Bond {
  std::size_t i, j;
  Int k;
};

struct Layers {
  std::vector<Level> levels;
  std::vector<Bond> bonds;  // of the pairs between runs, in their order
};

// Returns the time of stage j of S, in 1/65536.
Int time_of(Int j, Int S) { return 65536 * (j * j + j) / (S * S + S); }

// Returns k.
Int levelling(const State& state, const Pair& pair) {
  const Stages& stages = state.stages;
  const Int n = smaller(state.runs[pair.i].cells, state.runs[pair.j].cells);
  const Int one = ((((pair.c >> (8 + stages.bits)) * pair.s) >> 16) * scale_of(stages)) >>
                  (pair.direction.diagonal ? 16 : 14);
  return smaller(65535, n * one);
}

Layers find_layers(const State& state, const std::vector<Pair>& pairs) {
  Layers layers;
  std::vector<Int> number(state.cells.size(), -1);
  const auto level_of = [&](Int cell) {
    if (number[cell] < 0) {
      number[cell] = static_cast<Int>(layers.levels.size());
      Level level;
      level.head = smaller(Int{1} << 24, state.runs[cell].head - 512 * (state.place(cell).y - 2));
      layers.levels.push_back(level);
    }
    return static_cast<std::size_t>(number[cell]);
  };
  for (const Pair& pair : pairs)
    if (pair.between_runs)
      layers.bonds.push_back({level_of(pair.i), level_of(pair.j), levelling(state, pair)});
  return layers;
}

// Lets the cells take and give by I of the stage before, whose time is `time`.
void exchange(Layers& layers, Int time) {
  for (Level& level : layers.levels) level.taken = level.given = 0;
  for (const Bond& bond : layers.bonds) {
    Level* higher = &layers.levels[bond.i];
    Level* lower = &layers.levels[bond.j];
    if (higher->I < lower->I) std::swap(higher, lower);
    const Int flow = (bond.k * smaller(time >> 1, higher->I - lower->I)) >> 16;
    higher->given += flow;
    lower->taken += flow;
  }
}

// Does stage j = 2..S.
void do_stage(Layers& layers, Int j, Int S) {
  constexpr Int MOST = (Int{1} << 20) - 1;
  exchange(layers, time_of(j - 1, S));
  for (Level& level : layers.levels) {
    const Int gain = smaller(65535, level.taken) - smaller(65535, level.given);
    level.W = clamp(level.W + (2 * j - 1) * gain, -MOST, MOST);
    level.D += (level.W * ((4096 + (j >> 1)) / j)) >> 12;
    level.I = ((level.head * time_of(j, S)) >> 10) + level.D;
  }
}

}  // namespace

std::vector<Int> relaxed_drops(const State& state, const std::vector<Pair>& pairs) {
  const Int S = state.stages.S;
  Layers layers = find_layers(state, pairs);
  for (Level& level : layers.levels) level.I = (level.head * time_of(1, S)) >> 10;
  for (Int j = 2; j <= S; ++j) do_stage(layers, j, S);

  std::vector<Int> drops;
  std::size_t n = 0;
  for (const Pair& pair : pairs) {
    if (!pair.between_runs) {
      drops.push_back(0);
      continue;
    }
    const Bond& bond = layers.bonds[n++];
    drops.push_back(layers.levels[bond.i].I - layers.levels[bond.j].I);
  }
  return drops;
}

}  // namespace oracle
