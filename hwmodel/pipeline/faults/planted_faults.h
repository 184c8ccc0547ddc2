// These faults of a pipeline belong to no stage. They strike its channels, tiles and feeds, and the code of
// its memory.
#pragma once

#include "hwmodel/pipeline/faults/channel_fault.h"
#include "hwmodel/pipeline/faults/code_fault.h"
#include "hwmodel/pipeline/faults/irradiance_fault.h"
#include "hwmodel/pipeline/faults/tile_fault.h"

namespace voxmelt::hwmodel {

class PlantedFaults {
 public:
  // The plan and the pipeline must outlive it. It does nothing if the plan's fault is one of a stage.
  PlantedFaults(FaultPlan& plan, Pipeline& pipeline)
      : channel_(plan, pipeline), tile_(plan, pipeline), irradiance_(plan, pipeline), code_(plan, pipeline) {}

  // This must be called before each train of passes, and then before each of its passes.
  void begin_train() {
    channel_.begin_train();
    tile_.begin_train();
    irradiance_.begin_train();
    code_.begin_train();
  }
  void add_pass(const Pass& pass) {
    channel_.add_pass(pass);
    tile_.add_pass(pass);
    irradiance_.add_pass(pass);
    code_.add_pass(pass);
  }

 private:
  ChannelFault channel_;
  TileFault tile_;
  IrradianceFault irradiance_;
  PlantedCode code_;
};

}  // namespace voxmelt::hwmodel
