// OwnArch has the lanes of the instruction set that this object is compiled for. Sources that
// cmake/InstructionSets.cmake compiles once for each set include this file. They instantiate templates, and
// share nothing else.
#pragma once

#include "kernel/engine/cpu/instruction_set.h"
#include VOXMELT_LANES_HEADER  // "kernel/engine/cpu/lanes_<VOXMELT_INSTRUCTION_SET>.h"

namespace voxmelt::cpu {

using OwnArch = ArchOf<InstructionSet::VOXMELT_INSTRUCTION_SET>;

}  // namespace voxmelt::cpu
