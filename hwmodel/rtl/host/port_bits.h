// How many bits the inputs of the stages in SystemVerilog have.
#pragma once

#include <string_view>

namespace voxmelt::hwmodel {

// Returns the bits of a port that holds a number of the scene.
int port_bits(std::string_view name);

}  // namespace voxmelt::hwmodel
