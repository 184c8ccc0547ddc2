// The names of the committed scenes.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

namespace voxmelt::worlds {

inline std::vector<std::string> scene_names(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace voxmelt::worlds
