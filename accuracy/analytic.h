// Exact answers. Lengths are in cells, times in steps, temperatures in any one unit.
#pragma once

#include <vector>

namespace voxmelt::accuracy {

// Cell^2 per step that Eq. 1 of the paper conducts with 6, 18 or 26 neighbours, gamma / pi x 1, 3, 13/3.
double diffusivity(double gamma, int neighbours);

// Front of the one-phase Stefan problem: 2 lambda sqrt(D t), where the solid is at the melting point and the
// wall above it. St = (wall - melting point) / latent heat, above 0.
double stefan_lambda(double stefan);

// The same with a solid below the melting point: `stefan_solid` = (melting point - solid) / latent heat, at
// least 0.
double stefan_lambda(double stefan, double stefan_solid);

// Temperature behind and ahead of that front, at depth x below the wall. 1 is the wall, 0 the melting point,
// and the solid far away is at -stefan_solid / stefan.
double stefan_temperature(double x, double time, double diffusivity, double stefan, double stefan_solid);

// Temperature of a slab: 0 at first, x = 0 is held at 1 and x = depth insulated.
double slab_temperature(double x, double time, double diffusivity, double depth);

// Huppert (1982): viscous gravity currents on a plane, kappa = g dt / nu.
struct Drop {  // of constant volume, round
  double kappa, volume;
  double front(double time) const;
  double rms_radius(double time) const;
  double height(double radius, double time) const;
  double time_of_front(double front) const;
};
struct Dam {  // of constant area, in a channel; `area` lies on the one side of x = 0 that is looked at
  double kappa, area;
  double front(double time) const;
  double height(double x, double time) const;
  double rms_length(double time) const;  // root of the mean of x^2
  double time_of_front(double front) const;
};
Dam dam_of_depth(double kappa, double depth, double front);  // on Huppert's profile, `depth` at x = 0

// The same flow from any start, by finite volumes, for starts that have no formula. It gives depths at the
// middles of cells along a channel with closed ends, `parts_per_cell` of them to a cell.
std::vector<double> lubrication_flow(double kappa, std::vector<double> depth, double time,
                                     int parts_per_cell);

// A round current that a constant flux feeds at the origin, in cells per step. It has no formula: its profile
// is integrated.
struct FedCurrent {
  double kappa, flux;
  double front(double time) const;  // 0.715 (kappa flux^3 / 3)^(1/8) t^(1/2)
  double rms_radius(double time) const;
  double height(double radius, double time) const;  // without bound towards the origin
};

// Velocity per h^2 of a film that runs down a plane: Nusselt's film, its depth measured along gravity. A film
// of depth h carries kappa / 3 x nusselt(slope) x h^3 per width. slope: cells down per cell along.
double nusselt(double slope);

// Height above the bottom at which shafts stand that a roofed tunnel joins. Under a ceiling, a column that is
// overfull by o has its head stiffness x o above the ceiling. Of an incompressible liquid it is infinite.
double conduit_level(double volume, double open_area, double roofed_area, double ceiling, double stiffness);

// Part of a sphere's surface power 1 that a ball takes up: the solid angle over 4 pi, times 4 pi. The source
// is `distance` from its centre and gives 1 / r^2 to what faces it.
double ball_intercepts(double radius, double distance);

}  // namespace voxmelt::accuracy
