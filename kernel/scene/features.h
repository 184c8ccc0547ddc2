// The features of a scene have names. `voxmelt list` shows them, and they tell what a step must do.
#pragma once

#include <string>
#include <vector>

#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::scene {

// Lists all names, in the order in which features_of lists them.
const std::vector<std::string>& feature_names();

std::vector<std::string> features_of(const rule::Parameters& parameters);

}  // namespace voxmelt::scene
