// The report of a memory tells what it did, in words and as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "hwmodel/memory/counts.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel {

std::string memory_text(const memory::Counts& counts, const memory::Parameters& parameters);
nlohmann::ordered_json memory_json(const memory::Counts& counts, const memory::Parameters& parameters);

}  // namespace voxmelt::hwmodel
