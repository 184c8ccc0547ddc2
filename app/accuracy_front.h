// voxmelt accuracy --front: speed against error.
#pragma once

#include <string>
#include <vector>

#include "accuracy/case.h"
#include "app/options.h"

namespace voxmelt::app {

struct FrontOptions {
  std::vector<std::string> scenes;  // empty: all of the set
  std::string out;
  bool quick = false;
};

// `conditions.scenes`: the folder of the scenes themselves. Throws UsageError.
int run_front(const Common& common, const FrontOptions& options, const accuracy::Conditions& conditions);

}  // namespace voxmelt::app
