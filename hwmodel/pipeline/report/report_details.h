// The page of the report draws these details beside the numbers of the table: shares, bounds, trains of
// passes, and what every stage did when.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "hwmodel/pipeline/check/verify.h"

namespace voxmelt::hwmodel {

// Adds the details to a report that has the rest.
void add_details(nlohmann::ordered_json& json, const VerifyReport& report, const Design& design,
                 const Configuration& configuration);

}  // namespace voxmelt::hwmodel
