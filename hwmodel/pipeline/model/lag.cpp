#include "hwmodel/pipeline/model/lag.h"

namespace voxmelt::hwmodel {

Lag lag_of(StageKind kind, const Design& design) {
  using enum StageKind;
  switch (kind) {
    case conduction:  // the face towards +z
    case walls:       // the side towards +z
      return {1, 0, 0, 1};
    case edges:           // two axes at most
    case pattern:         // the diagonal towards +x, +z
    case apply:           // the same
    case viscous_spread:  // the same
      return {1, 1, 0, 1};
    case corners:
      return {1, 1, 1, 1};
    case fall:        // the cell above
    case convection:  // the same
      return {0, 0, 1};
    case gravity:  // the cell above; where films hang or cells are set, also the one above that
      return {0, 0, design.needs_ceilings() ? 2 : 1};
    case settle:  // a column reversed twice, one token of look-ahead
      return {0, 2, 1};
    default:
      return {0, 0, 0};
  }
}

}  // namespace voxmelt::hwmodel
