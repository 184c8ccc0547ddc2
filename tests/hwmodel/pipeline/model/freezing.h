// Hostile worlds may freeze, and their solids may be of several materials. The reference's phase melt says
// which places are set in them.
#pragma once

#include "kernel/engine/scalar/reference.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::hwmodel {

inline rule::Parameters freezing_parameters(worlds::Random& random, rule::Law law, const state::Grid& grid) {
  rule::Parameters parameters = worlds::hostile_parameters(random, law, grid);
  worlds::may_freeze(random, parameters);
  return parameters;
}

// Makes a hostile volume for the last of these parameters, which get the materials of its solids.
inline state::Volume volume_of_materials(worlds::Random& random, rule::Parameters& parameters,
                                         const state::Grid& grid) {
  state::Volume volume = worlds::hostile_volume(random, parameters, grid);
  worlds::may_be_of_materials(random, parameters, volume);
  return volume;
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
