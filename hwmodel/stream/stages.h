// The stages of one time step, in the order of the stream. A scene gets only those that it uses.
#pragma once

#include <memory>
#include <vector>

#include "hwmodel/stream/stage.h"

namespace voxmelt::hwmodel {

// Reads a feed of irradiance beside its input: only radiation.
class FedStage : public Stage {
 public:
  using Stage::Stage;
  void feed(HeatFifo& feed) { feed_ = &feed; }

 protected:
  HeatFifo* feed_ = nullptr;
};

using Stages = std::vector<std::unique_ptr<Stage>>;

std::unique_ptr<Stage> make_source(const Design& design);
std::unique_ptr<Stage> make_conduction(const Design& design);  // faces; also exposed axes and sides
std::unique_ptr<Stage> make_edge_conduction(const Design& design);
std::unique_ptr<Stage> make_corner_conduction(const Design& design);
std::unique_ptr<Stage> make_convection(const Design& design);
std::unique_ptr<FedStage> make_exchange(const Design& design);  // radiation and air
std::unique_ptr<Stage> make_melt(const Design& design);
std::unique_ptr<Stage> make_walls(const Design& design);  // cold paper law: sides, for gravity
std::unique_ptr<Stage> make_gravity(const Design& design);
std::unique_ptr<Stage> make_pattern(const Design& design);
std::unique_ptr<Stage> make_apply(const Design& design);
std::unique_ptr<Stage> make_settle(const Design& design);
std::unique_ptr<Stage> make_viscous_spread(const Design& design);

// All of a step; `fed`: the one that reads irradiance, or null.
struct StepStages {
  Stages stages;
  FedStage* fed = nullptr;
};
StepStages make_step(const Design& design);

}  // namespace voxmelt::hwmodel
