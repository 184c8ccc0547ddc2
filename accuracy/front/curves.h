// The sweep compares four curves over the time of a run. They are in lengths of the scene's own file, so that
// runs on any grid and with any step can be laid beside each other.
#pragma once

#include <array>
#include <vector>

#include "accuracy/formats/twin.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::accuracy::front {

// Converts places of a grid to the scene's own lengths.
struct Scale {
  double grid = 1;                // cells per cell of the scene's file
  double floor = 0;               // height of the floor's upper face, in cells of the grid
  double axis_x = 0, axis_z = 0;  // the vertical axis, in cells of the scene's file
};

struct Sample {
  double liquid = 0;  // cells of the scene's file that are liquid
  double heat = 0;    // sum of amount x heat, in such cells at the top of the range
  double height = 0;  // height of the centre of mass of all matter, above the floor
  double radius = 0;  // root of the mean square distance of all matter from the vertical axis
};
using Curves = std::vector<Sample>;  // taken at equal times

Sample sample_of(const Twin& twin, const Scale& scale);
Sample sample_of(const state::Volume& volume, const Scale& scale);

// Holds for each curve the mean of |one - reference| over the mean of the reference.
struct Errors {
  double liquid = 0, heat = 0, height = 0, radius = 0;
  double largest() const;
};
inline constexpr std::array<const char*, 4> kCurveNames{"liquid", "heat", "height", "radius"};
inline constexpr std::array<double Errors::*, 4> kCurves{&Errors::liquid, &Errors::heat, &Errors::height,
                                                         &Errors::radius};

// Throws std::invalid_argument unless both have the same number of samples.
Errors errors(const Curves& found, const Curves& reference);

}  // namespace voxmelt::accuracy::front
