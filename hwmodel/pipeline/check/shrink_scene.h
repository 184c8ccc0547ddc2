// A run that fails is made small, and becomes a scene that shows the failure.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/pipeline/check/shrink.h"
#include "hwmodel/pipeline/check/verify.h"
#include "kernel/scene/scene.h"

namespace voxmelt::hwmodel {

struct ShrinkRequest {
  std::filesystem::path fields;        // folder of the scene's fields; a folder beside it is used meanwhile
  double seconds = 45;                 // longest time of the search
  const scene::Scene& scene;           // its file and its parameters
  std::vector<std::string> overrides;  // overrides of the scene
  const step::Implementation& fast;    // the software kernel
  VerifyOptions options;               // options of the run that failed
  std::function<void()> poll;          // called now and then; what it throws ends everything
};

struct SmallScene {
  Case small;
  int cells = 0;      // cells that hold something
  int tried = 0;      // number of runs
  std::string stage;  // place of the difference, without the number of a channel's time step
  std::string text;   // the scene file, which takes its fields from `fields`
};

// Returns nothing if the state before the difference does not show it again.
std::optional<SmallScene> shrink_to_scene(const ShrinkRequest& request, const VerifyReport& report);

}  // namespace voxmelt::hwmodel
