// The option `voxmelt verify --shrink` makes a run that fails small, and writes it as a scene file.
#pragma once

#include <string>

#include "app/verify_command.h"
#include "hwmodel/caster/check/verify_picture.h"

namespace voxmelt::app {

// Writes the scene, and a folder with its fields beside it. Returns what is left in one sentence, and the
// command that shows it fail.
std::string make_small(const VerifyCommand& command, const scene::Scene& scene,
                       const hwmodel::VerifyOptions& options, const hwmodel::VerifyReport& report);
// Does the same for a picture.
std::string make_small_picture(const VerifyCommand& command, const scene::Scene& scene,
                               const hwmodel::raycast::PictureInput& input,
                               const hwmodel::raycast::PictureOptions& options,
                               const hwmodel::raycast::PictureReport& report);

}  // namespace voxmelt::app
