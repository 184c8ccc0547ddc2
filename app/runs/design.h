// A design takes values from the axes of a plan, and makes runs of them.
#pragma once

#include <string>
#include <vector>

#include "app/runs/plan.h"

namespace voxmelt::app {

struct PlannedRun {
  std::string name;               // a folder's name, made of the values: the same values have the same name
  std::vector<AxisValue> values;  // one of each axis
};

// Makes the runs of a plan, in order: of a grid the last axis changes first. Throws scene::InputError if
// there are too many, or two are the same.
std::vector<PlannedRun> runs_of(const Plan& plan);

// Returns "path.to.key=value", as of --set.
std::string set_of(const Axis& axis, const AxisValue& value);

}  // namespace voxmelt::app
