// The command `voxmelt accuracy --front` compares the speed of settings with their error.
#pragma once

#include <string>
#include <vector>

#include "accuracy/case.h"
#include "app/options.h"

namespace voxmelt::app {

struct FrontOptions {
  std::vector<std::string> scenes;  // all of the set if empty
  std::string out;
  bool quick = false;
};

// Runs the front. `conditions.scenes` is the folder of the scenes themselves. Throws UsageError.
int run_front(const Common& common, const FrontOptions& options, const accuracy::Conditions& conditions);

}  // namespace voxmelt::app
