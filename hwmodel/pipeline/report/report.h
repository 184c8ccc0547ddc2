// `voxmelt verify` reports a table for people, and JSON for programs.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hwmodel/pipeline/check/verify.h"

namespace voxmelt::hwmodel {

nlohmann::ordered_json json_of(const VerifyReport& report, const Design& design,
                               const Configuration& configuration);
// Shows the cycles of every stage, its buffers, the channels, and the bounds beside the result.
std::string table_of(const VerifyReport& report, const Design& design, const Configuration& configuration);

}  // namespace voxmelt::hwmodel
