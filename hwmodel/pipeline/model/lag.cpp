#include "hwmodel/pipeline/model/lag.h"

#include <algorithm>

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

Openings openings_of(const Design& design) {
  const rule::Parameters& parameters = design.parameters;
  return {std::max(2, static_cast<int>(parameters.vents.size())),
          std::max(2, static_cast<int>(parameters.drains.size()))};
}

int registers_of(StageKind kind, const Design& design) {
  return design.registers ? circuit_registers(kind, design) : 0;
}

int circuit_registers(StageKind kind, const Design& design) {
  using enum StageKind;
  const Openings openings = openings_of(design);
  const int curve = design.of_materials() ? kCurveRegisters : 0;
  switch (kind) {
    case fall:
    case walls:
      return 1;
    case source:
      return 8 + kOpeningRegisters * (openings.vents + openings.drains);
    case conduction:
      return 7 + curve;
    case convection:
      return 7;
    case edges:
      return 9 + curve;
    case corners:
      return 8 + curve;
    case exchange:  // before the air, and before it glows
      return 22 + 2 * curve;
    case melt:
      return 5;
    case gravity:  // its circuit always looks at the cell above the upper one
      return 40 - lag_of(kind, design).singles;
    case pattern:
      return 9;
    case apply:
      return 37;
    case viscous_spread:
      return 57;
    case settle:  // 23 of the first scan, 7 of the second one, 39 of the third one
      return 69;
    default:
      return 0;
  }
}

}  // namespace voxmelt::hwmodel
