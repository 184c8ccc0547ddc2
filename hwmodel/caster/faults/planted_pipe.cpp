#include "hwmodel/caster/faults/planted_pipe.h"

#include <memory>

#include "hwmodel/caster/faults/clear_faults.h"
#include "hwmodel/caster/faults/fetch_faults.h"
#include "hwmodel/caster/faults/flow_faults.h"
#include "hwmodel/caster/faults/light_faults.h"
#include "hwmodel/caster/faults/ray_faults.h"
#include "hwmodel/caster/faults/surface_faults.h"
#include "hwmodel/caster/faults/tile_faults.h"
#include "hwmodel/caster/model/pipe_of.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// This policy takes the place of NoFaults.
struct CasterFaults : RayFaults,
                      FetchFaults,
                      SurfaceFaults,
                      LightFaults,
                      TileFaults,
                      FlowFaults,
                      ClearFaults {
  CasterFaults(FaultPlan& plan, const Registers& registers, const Memory& memory,
               const std::shared_ptr<LastReply>& last_reply)
      : RayFaults(plan, registers, memory),
        FetchFaults(plan, registers, memory),
        SurfaceFaults(plan, registers, memory),
        LightFaults(plan, registers, memory),
        TileFaults(plan, registers, memory),
        FlowFaults(plan, registers, memory, last_reply),
        ClearFaults(plan, registers, memory) {}
};

}  // namespace

PipeMaker planted_pipes(FaultPlan& plan) {
  return [&plan, last = std::make_shared<LastReply>()](
             const Registers& registers, const FrameRegisters& frame, const Memory& memory,
             const Configuration& c, int number) -> std::unique_ptr<Pipe> {
    return std::make_unique<PipeOf<CasterFaults>>(registers, frame, memory, c, number,
                                                  CasterFaults(plan, registers, memory, last));
  };
}

}  // namespace voxmelt::hwmodel::raycast
