// The end of the grid is no side with this fault. It strikes without heat, where the stage `walls` finds the
// sides.
#pragma once

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/walls_stage.h"

namespace voxmelt::hwmodel {

class WallsFaults : public Planted {
 public:
  using Planted::Planted;

  void gave(const Stage& stage, int lane, Cell& cell) { miss_side(stage, Fault::side_missed, lane, cell); }
};

}  // namespace voxmelt::hwmodel
