// The page of a picture and that of the whole machine share the ray caster's report.
#pragma once

#include <string>

#include "report/hardware/parts.h"

namespace voxmelt::hwmodel::parts {

std::string caster_cards(const Json& report);

}  // namespace voxmelt::hwmodel::parts
