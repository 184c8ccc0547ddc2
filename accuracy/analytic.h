// The functions here give exact answers. Lengths are in cells, times in steps, temperatures in any one unit.
#pragma once

#include <vector>

namespace voxmelt::accuracy {

// Gives the cell^2 per step that Eq. 1 of the paper conducts with 6, 18 or 26 neighbours. That is gamma / pi
// times 1, 3 or 13/3.
double diffusivity(double gamma, int neighbours);

// Gives lambda for the front of the one-phase Stefan problem, which is at 2 lambda sqrt(D t). The solid is at
// the melting point and the wall above it. St = (wall - melting point) / latent heat, above 0.
double stefan_lambda(double stefan);

// Does the same for a solid below the melting point. `stefan_solid` = (melting point - solid) / latent heat
// is at least 0.
double stefan_lambda(double stefan, double stefan_solid);

// Gives the temperature behind and ahead of that front, at depth x below the wall. 1 is the wall, 0 the
// melting point, and the solid far away is at -stefan_solid / stefan.
double stefan_temperature(double x, double time, double diffusivity, double stefan, double stefan_solid);

// Gives the temperature of a slab that is at 0 at first. It is held at 1 at x = 0 and insulated at x = depth.
double slab_temperature(double x, double time, double diffusivity, double depth);

// Huppert (1982) solved viscous gravity currents on a plane. Here kappa = g dt / nu.
struct Drop {  // round, with a constant volume
  double kappa, volume;
  double front(double time) const;
  double rms_radius(double time) const;
  double height(double radius, double time) const;
  double time_of_front(double front) const;
};
struct Dam {  // in a channel, with a constant area; `area` lies on the one side of x = 0 that is looked at
  double kappa, area;
  double front(double time) const;
  double height(double x, double time) const;
  double rms_length(double time) const;  // root of the mean of x^2
  double time_of_front(double front) const;
};
Dam dam_of_depth(double kappa, double depth, double front);  // on Huppert's profile, `depth` at x = 0

// Solves the same flow from any start by finite volumes, for starts that have no formula. It gives depths at
// the middles of cells along a channel with closed ends, `parts_per_cell` of them to a cell.
std::vector<double> lubrication_flow(double kappa, std::vector<double> depth, double time,
                                     int parts_per_cell);

// A constant flux in cells per step feeds this round current at the origin. It has no formula: its profile is
// integrated.
struct FedCurrent {
  double kappa, flux;
  double front(double time) const;  // 0.715 (kappa flux^3 / 3)^(1/8) t^(1/2)
  double rms_radius(double time) const;
  double height(double radius, double time) const;  // grows without bound towards the origin
};

// Gives the velocity per h^2 of a film that runs down a plane: Nusselt's film, its depth measured along
// gravity. A film of depth h carries kappa / 3 x nusselt(slope) x h^3 per width. The slope is in cells down
// per cell along.
double nusselt(double slope);

// Gives the thickness, across the bed, of a film that runs down a horizontal cylinder, at `angle` radians
// from its top: Nusselt's film on the slope of that place. `flux` per width and step runs down this side.
double cylinder_film(double kappa, double flux, double angle);

// Gives the height of liquid above the bottom in shafts that a roofed tunnel joins. Under a ceiling, a column
// that is overfull by o has its head stiffness x o above the ceiling. The stiffness of an incompressible
// liquid is infinite.
double conduit_level(double volume, double open_area, double roofed_area, double ceiling, double stiffness);

// Gives the part of a sphere's surface power 1 that a ball takes up: the solid angle over 4 pi, times 4 pi.
// The source is `distance` from its centre and gives 1 / r^2 to what faces it.
double ball_intercepts(double radius, double distance);

}  // namespace voxmelt::accuracy
