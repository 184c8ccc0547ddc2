// The instruction set that the native baseline needs: it is compiled for the processor of the build.
#pragma once

namespace voxmelt::measure {

// Data, no code: the file that defines it is compiled like that baseline.
extern const int kNativeNeeds;  // index into cpu::kInstructionSets; -1: nothing

}  // namespace voxmelt::measure
