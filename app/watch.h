// What goes wrong in a run without any error: found while it runs, said at its end.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/run/simulation.h"

namespace voxmelt::app {

class Watch {
 public:
  // Looks for liquid that is compressed in the open: more than two cells in one, and nothing above it but the
  // border. Where a vent brings more than flows away, its column reaches the top of the grid and fills up.
  void look(const state::Volume& volume, std::uint32_t step);

  std::vector<std::string> warnings(const run::Simulation& simulation) const;

 private:
  int largest_ = 0;  // amount of such a cell, or two cells
  int x_ = 0, y_ = 0, z_ = 0;
  std::uint32_t step_ = 0;
};

}  // namespace voxmelt::app
