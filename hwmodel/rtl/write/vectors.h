// The tokens of a test bench, as $readmemh reads them: a line for each, its number in hexadecimal digits.
#pragma once

#include <string>

#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

// Returns the cells of a state, with `bits` for each. Lanes beyond the grid are the border.
std::string cell_lines(const state::Volume& volume, const Shape& shape, int bits);
// Returns the irradiance, 16 bits for each cell. Null: all is dark.
std::string irradiance_lines(const Irradiance* irradiance, const Shape& shape);
// Returns which cells fall, a bit for each. Null: none does.
std::string fall_lines(const state::BitPlane* falling, const Shape& shape);

}  // namespace voxmelt::hwmodel
