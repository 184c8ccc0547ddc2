// The named features of a scene, for `voxmelt list` and for choosing what a step must do.
#pragma once

#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::scene {

// All names, in the order in which features_of lists them.
const std::vector<std::string>& feature_names();

std::vector<std::string> features_of(const rule::Parameters& parameters);

}  // namespace voxmelt::scene
