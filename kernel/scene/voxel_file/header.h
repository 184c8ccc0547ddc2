// Numbers of headers that are text.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "kernel/scene/voxel_file/voxels.h"

namespace voxmelt::scene {

std::string trimmed(std::string_view text);  // without blanks at its ends

// They fail with the name of the field.
std::vector<double> numbers_in(std::string_view text, const char* field, const VoxelSource& source);
std::array<double, 3> three_lengths(std::string_view text, const char* field, const VoxelSource& source);
std::array<std::uint64_t, 3> three_sides(std::string_view text, const char* field, const VoxelSource& source);
void check_spacing(double side, const VoxelSource& source);

}  // namespace voxmelt::scene
