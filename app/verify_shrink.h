// voxmelt verify --shrink: a run that fails, made small, as a scene file.
#pragma once

#include <string>

#include "app/verify_command.h"
#include "hwmodel/caster/check/verify_picture.h"

namespace voxmelt::app {

// Writes the scene, and a folder with its fields beside it. Gives what is left in one sentence, and what to
// type to see it fail.
std::string make_small(const VerifyCommand& command, const scene::Scene& scene,
                       const hwmodel::VerifyOptions& options, const hwmodel::VerifyReport& report);
// The same of a picture.
std::string make_small_picture(const VerifyCommand& command, const scene::Scene& scene,
                               const hwmodel::raycast::PictureInput& input,
                               const hwmodel::raycast::PictureOptions& options,
                               const hwmodel::raycast::PictureReport& report);

}  // namespace voxmelt::app
