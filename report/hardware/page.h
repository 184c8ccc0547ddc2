// The pages of `voxmelt verify --html` are each made from the JSON report of its run, and from nothing else.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace voxmelt::hwmodel {

// Each page's `title` says which scene and steps it shows.
std::string pipeline_page(const nlohmann::ordered_json& report, const std::string& title);
std::string picture_page(const nlohmann::ordered_json& report, const std::string& title);
std::string machine_page(const nlohmann::ordered_json& report, const std::string& title);

}  // namespace voxmelt::hwmodel
