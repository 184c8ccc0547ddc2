// A plain program in one dimension: a sheet of liquid runs out of its own weight, cools, and stops where it
// is cold. It knows nothing of cells, and each place has one temperature. Lengths are in cells, times in
// steps.
#pragma once

#include <vector>

namespace voxmelt::accuracy {

struct CoolingSheet {
  double kappa;          // g dt / nu
  double exchange;       // film coefficient to the air, per step and unit of area
  double conductance;    // between two cells of the grid, cell^2 per step
  double latent;         // heat over temperature
  double air, freezing;  // temperatures; below `freezing` liquid stays where it is

  // Returns the depths at the middles of parts, `parts_per_cell` of them to a cell, when all is cold. The
  // channel has closed ends.
  std::vector<double> at_rest(std::vector<double> depth, double temperature, int parts_per_cell) const;
};

}  // namespace voxmelt::accuracy
