#include "hwmodel/caster/model/pipe.h"

#include <memory>

#include "hwmodel/caster/model/no_faults.h"
#include "hwmodel/caster/model/pipe_of.h"

namespace voxmelt::hwmodel::raycast {

std::unique_ptr<Pipe> make_pipe(const Registers& registers, const FrameRegisters& frame, const Memory& memory,
                                const Configuration& c, int number) {
  return std::make_unique<PipeOf<NoFaults>>(registers, frame, memory, c, number);
}

}  // namespace voxmelt::hwmodel::raycast
