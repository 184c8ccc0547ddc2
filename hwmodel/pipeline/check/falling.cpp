#include "hwmodel/pipeline/check/falling.h"

#include "kernel/engine/scalar/pieces.h"

namespace voxmelt::hwmodel {

std::optional<state::BitPlane> cells_that_fall(const rule::Parameters& parameters, std::uint32_t step,
                                               const state::Volume& before) {
  if (!parameters.pieces.fall) return {};
  return scalar::falling_cells(parameters.pieces, step, before);
}

}  // namespace voxmelt::hwmodel
