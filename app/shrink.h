// voxmelt verify --shrink: a run that fails, made small, as a scene file.
#pragma once

#include <string>

#include "app/options.h"
#include "hwmodel/pipeline/check/verify.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

struct ShrinkRequest {
  std::string file;           // the scene that is written; its fields go into a folder beside it
  double seconds = 45;        // that the search may take
  const Common& common;       // who computes, and the overrides of the scene
  const scene::Scene& scene;  // its file and its parameters
  hwmodel::VerifyOptions options;
  std::string plant;
};

// The scene that is left, in one sentence, and what to type to see it fail.
std::string shrink(const ShrinkRequest& request, const hwmodel::VerifyReport& report);

// Where the fields of the scene go.
std::string fields_folder(const std::string& file);

}  // namespace voxmelt::app
