// A run that fails, made small, as a scene that shows it.
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
  std::filesystem::path fields;  // the folder of the scene's fields; another beside it is used meanwhile
  double seconds = 45;           // that the search may take
  const scene::Scene& scene;     // its file and its parameters
  std::vector<std::string> overrides;  // of the scene
  const step::Implementation& fast;    // the software
  VerifyOptions options;               // of the run that failed
  std::function<void()> poll;          // called now and then; what it throws ends everything
};

struct SmallScene {
  Case small;
  int cells = 0;      // that hold something
  int tried = 0;      // runs
  std::string stage;  // where it differs, without the number of a channel's time step
  std::string text;   // the scene file, which takes its fields from `fields`
};

// None: the difference is not seen again from the state before it.
std::optional<SmallScene> shrink_to_scene(const ShrinkRequest& request, const VerifyReport& report);

}  // namespace voxmelt::hwmodel
