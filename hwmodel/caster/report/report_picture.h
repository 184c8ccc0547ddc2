// The report of a ray caster's run is a table and a verdict.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hwmodel/caster/check/verify_picture.h"

namespace voxmelt::hwmodel::raycast {

std::string table_of(const PictureReport& report, const Configuration& configuration);
nlohmann::ordered_json json_of(const PictureReport& report, const Configuration& configuration);
nlohmann::ordered_json json_of(const UploadReport& upload);
std::string verdict_text(const PictureReport& report);

}  // namespace voxmelt::hwmodel::raycast
