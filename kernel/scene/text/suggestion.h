// The nearest known name to a misspelt one.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace voxmelt::scene {

// Insertions, deletions, substitutions and swaps of neighbours that turn one word into the other.
std::size_t edit_distance(std::string_view a, std::string_view b);

// The known name nearest to `name`, or empty when none is near enough to be meant.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace voxmelt::scene
