#include "accuracy/case.h"
#include "accuracy/heat.h"
#include "accuracy/light.h"

namespace voxmelt::accuracy {

const std::vector<Case>& all_cases() {
  static const std::vector<Case> cases{
      {"heat_kernel", "Heat", "A Gaussian of heat widens: its second moment grows by 6 D per step",
       "Eq. 1 with 6, 18 and 26 neighbours against the heat kernel. The Gaussian starts with sigma 6 and a "
       "peak "
       "of 60,000 units, and its variance triples.",
       measure_heat_kernel},
      {"slab", "Heat", "A slab between a wall and an insulator warms as Fourier's series says",
       "A column of 64 cells. Its upper face is held at a temperature, its lower one passes no heat.",
       measure_slab},
      {"stefan", "Heat", "One-phase Stefan problem: the melting front moves as the square root of time",
       "A column of 64 cells at its melting point, under a wall of fixed temperature. The front is the "
       "latent "
       "heat taken up, and should be at 48 cells in the end. St is the wall's excess over the latent heat.",
       measure_stefan},
      {"stefan_two_phase", "Heat", "Two-phase Stefan problem: the solid is colder than its melting point",
       "As above, with a solid below its melting point, long enough that its far end stays cold.",
       measure_stefan_two_phase},
      {"checkerboard", "Heat", "A checkerboard of heat at the largest gamma decays, or the scene is refused",
       "Past von Neumann's bound, 0.39 for 6 neighbours, a hot cell and its cold neighbour may swap for "
       "ever. "
       "A scene that is refused or warned of counts as 0.",
       measure_checkerboard},
      {"lit_plane", "Light", "A plane under a far source takes up the cosine of the angle",
       "A plane of 65 x 65 cells, the source 2,000 cells away. The middle 21 x 21 columns are measured.",
       measure_lit_plane},
      {"lit_ball", "Light", "A ball takes up what its cross-section cuts out of the light",
       "A ball of radius 20, the source 50 radii away. What is exact is the solid angle of the ball.",
       measure_lit_ball},
      {"shadow_edge", "Light", "The shadow of a wall ends where geometry says",
       "A wall 12 cells high on a floor. The edge is the first cell that gets heat.", measure_shadow_edge},
  };
  return cases;
}

}  // namespace voxmelt::accuracy
