// A plain program in one dimension: a ball at its melting point melts from outside, shell by shell. It knows
// nothing of cells. Lengths are in cells, times in steps.
#pragma once

namespace voxmelt::accuracy {

// Heat comes by conduction from a wall that surrounds the ball at a distance. The melt stays where it is,
// as in a closed mould. St = (wall - melting point) / latent heat.
struct MouldedBall {
  double radius, gap, diffusivity, stefan;

  // Returns the steps until such a part of the ball has melted, 0 to 1.
  double time_of(double part) const;
};

// Hot air gives `rate` x latent heat to each unit of the surface per step, and what melts leaves at once.
struct BaredBall {
  double radius, rate;

  double time_of(double part) const;
};

}  // namespace voxmelt::accuracy
