#include <utility>
#include <vector>

#include "accuracy/ball.h"
#include "accuracy/books.h"
#include "accuracy/case.h"
#include "accuracy/cavities.h"
#include "accuracy/convergence.h"
#include "accuracy/freezing.h"
#include "accuracy/grid.h"
#include "accuracy/heat.h"
#include "accuracy/level.h"
#include "accuracy/light.h"
#include "accuracy/materials.h"
#include "accuracy/pieces.h"
#include "accuracy/rest.h"
#include "accuracy/slope.h"
#include "accuracy/spreading.h"

namespace voxmelt::accuracy {

namespace {

using Cases = std::vector<Case>;

Cases arithmetic() {
  return {
      {"books", "Arithmetic", "Mass, heat and energy balance to the unit",
       "The scenes proving_ground, in which every rule acts, under both laws. "
       "With --quick a tenth of the steps.",
       measure_books},
      {"implementations", "Arithmetic", "Every implementation gives the reference's bits",
       "The same scenes with every instruction set that this processor has, on one thread and on two. "
       "With --quick a tenth of the steps.",
       measure_implementations},
      {"limit", "Arithmetic", "What the limit of the mobility cuts is counted",
       "Three still pools, one of which is shallow enough. The counters of report.json beside a count by "
       "hand.",
       measure_limit},
  };
}

Cases heat() {
  return {
      {"heat_kernel", "Heat", "A Gaussian of heat widens: its second moment grows by 6 D per step",
       "Eq. 1 with 6, 18 and 26 neighbours against the heat kernel. The Gaussian starts with sigma 6 and a "
       "peak "
       "of 60,000 units, and its variance triples. "
       "With --quick one gamma for each.",
       measure_heat_kernel},
      {"slab", "Heat", "A slab between a wall and an insulator warms as Fourier's series says",
       "A column of 64 cells under an isothermal wall. Its lower face passes no heat.", measure_slab},
      {"stefan", "Heat", "One-phase Stefan problem: the melting front moves as the square root of time",
       "A column of 64 cells at its melting point, under an isothermal wall. The front is the "
       "latent "
       "heat taken up, and should be at 48 cells in the end. St is the wall's excess over the latent heat. "
       "With --quick a column of 40 cells, the front at 30, and fewer St.",
       measure_stefan},
      {"stefan_two_phase", "Heat", "Two-phase Stefan problem: the solid is colder than its melting point",
       "As above, with a solid below its melting point, long enough that its far end stays cold. "
       "With --quick the front goes 32 cells.",
       measure_stefan_two_phase},
      {"freezing", "Heat", "Stefan problems backwards: liquid freezes under a cold wall",
       "A column of liquid at its melting point, or warmer, under an isothermal wall. The front is the "
       "latent "
       "heat given off. The mask of solids is looked at, too. "
       "With --quick the warmer one goes 24 cells, not 64.",
       measure_freezing},
      {"crust", "Heat", "A crust on a pool grows as the square root of time",
       "Cold air over a pool at its melting point, St 0.2. The film of air counts as so much more of the "
       "crust, "
       "its conductance over that of the crust.",
       measure_crust},
      {"glow", "Heat", "A cell alone glows with the fourth power of its temperature",
       "A cell with three exposed axes loses heat to a sky at absolute zero.", measure_glow},
      {"cooling_flow", "Heat", "A dam breaks under cold air, and stops by itself",
       "A plain program in one dimension lets a sheet run, cool and stop where it is colder than it freezes. "
       "It "
       "has one temperature over the depth.",
       measure_cooling_flow},
      {"two_layers", "Heat", "A slab of two materials warms and melts as the exact series says",
       "A column of 64 cells under an isothermal wall. The half near it is of one material, the other of "
       "another. "
       "With --quick three pairs of materials, not six.",
       measure_two_layers},
      {"body_of_materials", "Heat", "A body of three materials takes up the heat that each of them needs",
       "A ball melts in an oven, and what melts is drained. The sums by hand are exact.",
       measure_body_of_materials},
      {"ball_in_mould", "Heat", "A ball melts in a hot mould that it fills",
       "A plain program conducts heat through 160 shells, St 1. What melts has no room to move. "
       "With --quick the ball of radius 20 is left out under the viscous law.",
       measure_ball_in_mould},
      {"ball_in_oven", "Heat", "A ball melts in an oven",
       "Air heats what is exposed, and what melts is drained at once. So the radius shrinks steadily.",
       measure_ball_in_oven},
      {"checkerboard", "Heat", "A checkerboard of heat at the largest gamma decays, or the scene is refused",
       "Above gamma 0.39, with 6 neighbours, hot and cold cells change places in each step and keep more "
       "than half of their difference. A scene that is refused or warned of counts as 0.",
       measure_checkerboard},
  };
}

Cases light() {
  return {
      {"lit_plane", "Light", "A plane under a far source takes up the cosine of the angle",
       "A plane of 65 x 65 cells, the source 2,000 cells away. The middle 21 x 21 columns are measured.",
       measure_lit_plane},
      {"lit_ball", "Light", "A ball takes up what its cross-section cuts out of the light",
       "A ball of radius 20, the source 50 radii away. The cross-section of its cells, which is larger than "
       "the ball's, is counted in pixels. What is left beside it is the light's error. With 16 rays per face "
       "every direction keeps the gate of 10 %; with fewer the worst is reported. "
       "With --quick 40 directions of 100.",
       measure_lit_ball},
      {"shadow_edge", "Light", "The shadow of a wall ends where geometry says",
       "A wall 12 cells high on a floor. The shadow is as long as the light that the floor lacks. With m x m "
       "rays "
       "to a face it may be wrong by 1/(2 m) of a cell, and the gate leaves 0.05 more.",
       measure_shadow_edge},
      {"dark_steps", "Light", "What melting bares takes up light at once",
       "A sun melts twelve layers of a slab, and a near source a third of a ball. A cell that melting bares "
       "is "
       "dark until the next step of visibility. At every step nothing may be lost; longer periods are "
       "reported.",
       measure_dark_steps},
  };
}

Cases spreading() {
  return {
      {"huppert", "Spreading", "A drop spreads as t^(1/8): depth 10 to 2",
       "A drop of constant volume on a plane, kappa 0.02, that starts on Huppert's similarity profile with "
       "radius 20. "
       "Its rms radius must hold at each of five samples.",
       measure_huppert},
      {"thin_film", "Spreading", "The same as a film: depth 2 to 0.4",
       "Kappa 0.1. Below depth 1/2 the film is thinner than the gates ask for, and is only reported. "
       "With --quick a drop of radius 14, not 20, and no step below 1/2.",
       measure_thin_film},
      {"flux_vent", "Spreading", "A vent of constant flux: the radius grows as t^(1/2)",
       "Five cells of liquid per step from a vent of radius 3. Huppert's profile of constant flux gives the "
       "rms radius, which the width of the vent leaves as it is. The wet area is at least 1/256 cell deep. "
       "With --quick half of the steps.",
       measure_flux_vent},
      {"dam_length", "Spreading", "A dam in a channel spreads as t^(1/5)",
       "A dam that starts on Huppert's profile, from depth 4 to 2, in the middle row of a channel 33 cells "
       "wide.",
       measure_dam_length},
      {"dam_width", "Spreading", "The dam has the same length in a channel of any width",
       "The same dam, from depth 4 to 2.6, in channels from 1 to 33 cells wide.", measure_dam_width},
      {"dam_refined", "Spreading", "A dam keeps to theory in cells of any size",
       "Cells of 2 to 1/4 units, and steps as many times shorter, with the sub-steps of the default. "
       "With --quick cells of 2 and 1 unit.",
       measure_dam_refined},
      {"dam_viscosity", "Spreading", "Dams of different viscosity are alike after equal kappa x steps",
       "Dams 16 high and 32 long. Beside them stands lubrication theory, integrated by finite volumes an "
       "eighth of a cell long. With --quick the channel is 9 cells wide, not 17.",
       measure_dam_viscosity},
      {"deep_lake", "Spreading", "A wave on a deep lake levels out at the rate of theory",
       "A lake 20 deep and 64 long, kappa 0.01, with a wave of one cell. It wants some 90 sub-steps. Relaxed "
       "heads (flow.viscous.stages_max) do with one; without them, few sub-steps hold it back.",
       measure_deep_lake},
      {"hump", "Spreading", "A steep hump on a pool sinks as lubrication theory says",
       "A Gaussian at the wall of a pool 3 deep, kappa 0.05, 24 steps. Its flanks are as steep as 2 cells "
       "per cell.",
       measure_hump},
      {"drop_shape", "Spreading", "A drop stays round",
       "A disc of radius 12 and depth 4 under both laws. The paper's law is no viscous liquid: its exponent "
       "is reported.",
       measure_drop_shape},
  };
}

Cases slopes() {
  return {
      {"nusselt", "Slopes", "A film on a plane carries Nusselt's flux",
       "Kappa 0.1. The flux through the middle of the plane is counted over 256 steps. "
       "With --quick the plane is 9 cells wide, not 33.",
       measure_nusselt},
      {"melting_film", "Slopes", "The same on a solid that melts",
       "The solid's surface lies where its amount and its heat say: full cells that are half melted, or half "
       "warmed without latent heat, carry a film as partly full ones do. "
       "Kappa 0.1 where it is cold, and 0.02 where it melts under a sun. "
       "With --quick slope 0.25 alone, and cold.",
       measure_melting_film},
      {"narrow_film", "Slopes", "The same between walls",
       "A film of depth 1.6 in channels from 1 to 9 cells wide.", measure_narrow_film},
      {"thermal_film", "Slopes", "The mobility doubles with every `doubling` of temperature",
       "A film of depth 1.6 at one temperature, slope 0.25. Its kappa is chosen so that it is 0.1 at this "
       "temperature. With --quick the plane is 9 cells wide, not 33.",
       measure_thermal_film},
      {"film_front", "Slopes", "The front of a film runs down a dry plane and keeps its shape",
       "Lubrication theory gives the shape of the front, and it goes with the film's mean velocity. "
       "Liquid may end up to a cell later, since a cell is dry or wet. "
       "With --quick the steepest and deepest alone.",
       measure_film_front},
      {"cylinder_film", "Slopes", "A film runs down the side of a cylinder",
       "The film is fed at the top of a horizontal cylinder. Nusselt's film on the slope of each place says "
       "how thick it is across the bed, at so many degrees from the top. Steeper than 45 degrees liquid "
       "falls "
       "beside the bed, without friction: this is reported.",
       measure_cylinder_film},
      {"stairs", "Slopes", "The same on steps of whole cells",
       "A bed that cannot be told from stairs holds liquid back. Reported. "
       "With --quick depth 0.5 alone.",
       measure_stairs},
      {"blob", "Slopes", "A blob runs straight down a plane at any angle to the grid",
       "A paraboloid of radius 12 and depth 1.6, kappa 0.1. Its centre of mass moves by the integral of h^3 "
       "over that of "
       "h, whatever its shape.",
       measure_blob},
  };
}

Cases levels() {
  return {
      {"tubes", "Levels", "Communicating vessels level: the scene lesson_tubes",
       "600 cells of liquid. Both shafts should stand at 52/9: under the roof of the tunnel a column that is "
       "overfull by o has a head 8 o above the ceiling. An incompressible liquid would stand at 6 cells. "
       "With --quick up to step 4,000.",
       measure_tubes},
      {"u_tube", "Levels", "A U-tube of 12 cells levels",
       "Shafts of 3 x 3 cells over a tunnel of 9 x 3 x 3. Its roofed part is squeezed as in the case "
       "tubes.",
       measure_u_tube},
      {"flood", "Levels", "Relaxed heads flood a lake as all sub-steps do",
       "A deep lake stands beside a shallow one, or a dry plane. Kappa 0.02.", measure_flood},
      {"rest", "Levels", "What should rest, rests",
       "A closed full box, a checkerboard pool, and a film with a yield stress, which may cost 3 % of "
       "roundness.",
       measure_rest},
      {"yield_heap", "Levels", "A heap with a yield stress comes to rest in its shape",
       "A block of 5 x 4 cells runs out from a wall, kappa 0.5. It should rest where depth times fall of the "
       "surface is the yield stress, as a parabola of known length (Liu and Mei 1989).",
       measure_yield_heap},
      {"cavities", "Levels", "A full cavity is at rest, whatever its ceiling",
       "Cavities of some 16 cells, closed all round and full. Each layer is hotter than the one below. "
       "Columns "
       "of different height stand beside each other, and give each other nothing.",
       measure_cavities},
      {"pieces", "Levels", "Pieces fall, sink and float",
       "A cube of 8 cells falls into a pool of 24 x 24 cells, 14.3 deep. It sinks by whole cells, so what "
       "floats may lie a cell off. "
       "With --quick 600 steps, not 1200, and density 0.5 alone.",
       measure_pieces},
      {"fall", "Levels", "A block falls whole, and a funnel of one cell empties a basin",
       "In free air liquid falls one cell per step. Of the basin, a film may stay.", measure_fall},
      {"filling", "Levels", "No cell in the open is squeezed",
       "A ball drops and a vent pours. A cell may hold a quarter more than one.", measure_filling},
      {"layers", "Levels", "Layers keep their heat when a column settles",
       "Cells that hold too little or too much become full ones. Each should have the heat of the parts of "
       "the column that it takes. Each part is 0.014 of the range hotter than the one below.",
       measure_layers},
  };
}

Cases convergence() {
  return {
      {"melted_ball", "Convergence", "A melted ball of 32, 64 and 128 cells spreads alike",
       "A ball of liquid falls apart under its weight. Physical time and viscosity are fixed, steps are as "
       "many times "
       "shorter as cells are smaller. With --quick the balls have 16 and 32 cells, and no gate.",
       measure_melted_ball},
      {"convergence_grid", "Convergence", "A melting ball on grids of 32, 64 and 128 cells",
       "One physical time. All numbers of the scene follow the size of its cells, and steps its square. "
       "With --quick the first two.",
       measure_convergence_in_grid},
      {"convergence_step", "Convergence", "A melting ball in shorter steps",
       "The grid of 32 cells, with steps a half and a quarter as long.", measure_convergence_in_step},
  };
}

Cases grid() {
  return {
      {"round_disc", "Grid", "A disc of liquid stays round while it spreads",
       "A disc four cells deep spreads on a plane; kappa 0.4, and the paper's law with the numbers of the "
       "scenes lava and goblet. The pile starts without energy, as high as its slope in the end wants. With "
       "--quick the radius 16 alone.",
       measure_round_disc},
      {"round_ball", "Grid", "A ball that melts from all sides stays a ball",
       "Hot air melts a ball, and what melts is drained at once. Its reach is the mean over cones of 15 "
       "degrees about the axes and the diagonals of faces and of space. With --quick the radius 12 alone.",
       measure_round_ball},
      {"straight_front", "Grid", "The front of a film stays straight at any angle to the grid",
       "A film of depth 1.6 lies uphill of a straight line, kappa 0.1. "
       "With --quick a smaller plane, one slope and two angles.",
       measure_straight_front},
  };
}

}  // namespace

const std::vector<Case>& all_cases() {
  static const Cases cases = [] {
    Cases all;
    for (Cases (*chapter)() : {arithmetic, heat, light, spreading, slopes, levels, convergence, grid})
      for (Case& one : chapter()) all.push_back(std::move(one));
    return all;
  }();
  return cases;
}

}  // namespace voxmelt::accuracy
