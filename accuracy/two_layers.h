// Two layers lie one behind the other, of two materials: the exact answer to how they warm.
#pragma once

namespace voxmelt::accuracy {

// Is at 0 at first, then held at 1 at x = 0, and insulated behind. Depths are in cells, conductivities in
// cell^2 per step over the first's capacity, capacities in any one unit.
struct TwoLayers {
  double depth[2], conductivity[2], capacity[2];

  // Gives the temperature at x, by the sum of the slab's own waves.
  double temperature(double x, double time) const;
  // Gives the time at which the temperature at x is a given one, below 1.
  double time_of(double x, double temperature) const;

 private:
  double wave_number(int layer, double rate) const;
  double misfit(double rate) const;
  double wave(double rate, double x, double time) const;
};

}  // namespace voxmelt::accuracy
