// The instruction set that the native baseline needs: it is compiled for the processor of the build.
#pragma once

#include <optional>

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::measure {

// Data, no code: the file that defines it is compiled like that baseline.
extern const std::optional<cpu::InstructionSet> kNativeNeeds;

}  // namespace voxmelt::measure
