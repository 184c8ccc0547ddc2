// The native baseline needs an instruction set: it is compiled for the processor of the build.
#pragma once

#include <optional>

#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::measure {

// This is data, no code: the file that defines it is compiled like that baseline.
extern const std::optional<cpu::InstructionSet> kNativeNeeds;

}  // namespace voxmelt::measure
