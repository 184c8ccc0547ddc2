// The nearest known name is suggested for a misspelt one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace voxmelt::scene {

// Counts insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

// Returns the known name nearest to `name`, or empty if none is near enough to be meant.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace voxmelt::scene
