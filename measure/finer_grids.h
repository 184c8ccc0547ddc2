// The same scene is drawn on finer and finer grids at the same size: a picture should cost little more.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "measure/drawing.h"

namespace voxmelt::measure {

struct FinerGrid {
  std::string scene;
  state::Grid grid;
  int rounds = 0;
  struct Timing {
    cpu::InstructionSet set;
    double fast, normal;  // seconds, on one thread
  };
  std::vector<Timing> timings;  // one for each drawer, in their order
};

// Returns how many times as long it took as on the grid before. There is nothing for the first grid.
std::optional<double> growth_of_normal(const std::vector<FinerGrid>& grids, std::size_t grid,
                                       std::size_t timing);

// Draws scenes in their order, each after `step` steps. `threads` melt them; all are drawn in the same
// rounds.
std::vector<FinerGrid> measure_finer_grids(const std::vector<scene::Scene>& scenes,
                                           const std::vector<Drawer>& drawers, int threads,
                                           const Rounds& rounds, std::uint32_t step);

}  // namespace voxmelt::measure
