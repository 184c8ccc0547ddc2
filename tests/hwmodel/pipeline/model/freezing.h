// Hostile worlds may freeze. The reference's phase melt says which places are set in them.
#pragma once

#include "kernel/engine/scalar/reference.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::hwmodel {

inline rule::Parameters freezing_parameters(worlds::Random& random, rule::Law law, const state::Grid& grid) {
  rule::Parameters parameters = worlds::hostile_parameters(random, law, grid);
  worlds::may_freeze(random, parameters);
  return parameters;
}

// Returns the places that are set behind the phase melt of this state.
inline state::BitPlane set_places(const rule::Parameters& parameters, const state::Volume& before_melt) {
  if (!parameters.freezes()) return state::BitPlane(before_melt.grid);
  scalar::Reference reference(parameters, before_melt.grid);
  state::Volume scratch = before_melt;
  state::Ledger ledger;
  reference.run(step::Phase::melt, step::Moment(0), nullptr, scratch, ledger);
  return reference.set_cells();
}

}  // namespace voxmelt::hwmodel
