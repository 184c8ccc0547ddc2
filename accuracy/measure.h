// The functions here take numbers from a volume: columns of liquid, radii, moments, fronts.
#pragma once

#include <functional>
#include <vector>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy {

// Holds the liquid per column, in cells. Its x and z count from the middle of the grid, at centres of
// columns.
struct Columns {
  explicit Columns(const state::Volume& volume);
  double at(int x, int z) const { return depth[z * nx + x]; }
  double x_of(int x) const { return x - (nx - 1) / 2.0; }
  double z_of(int z) const { return z - (nz - 1) / 2.0; }

  int nx, nz;
  std::vector<double> depth;
};

struct Moments {
  double volume = 0;
  double x = 0, z = 0;    // centre
  double rms_radius = 0;  // about the middle of the grid
  double a4 = 1;          // four-fold moment about the middle: 1 is round
};
Moments moments(const Columns& columns);

// Returns the radius of the disc that covers as many columns as are at least `depth` deep.
double wet_radius(const Columns& columns, double depth);

// Returns the root of the mean square of measured - exact over the columns that either has, over the mean
// depth.
double profile_error(const Columns& columns, const std::function<double(double radius)>& exact);

// Returns the mean depth over rings one cell wide, from the middle out.
std::vector<double> radial_profile(const Columns& columns);

// Returns the second moment of heat about the grid's middle: sum h r^2 / sum h, in cells^2.
double heat_second_moment(const state::Volume& volume);

// Returns how many cells of latent heat the volume has taken up, partly molten cells included. All cells
// started at or below the melting point.
double melted_cells(const state::Volume& volume, double melting_point, double latent_heat);

}  // namespace voxmelt::accuracy
