// The stages of the phases source, heat and melt are put together as by make_step.
#pragma once

#include <memory>

#include "tests/hwmodel/pipeline/model/phase_world.h"

namespace voxmelt::hwmodel {

// Checks, behind a phase, that its cells bring no side bands, except the bits that conduction hands to
// gravity and to melt.
class NoSideBands final : public Stage {
 public:
  NoSideBands(const Design& design, StageKind before) : Stage(before, design, 0) {}

 private:
  void advance(const Cell* in, Cell* out) override {
    for (int lane = 0; lane < lanes(); ++lane) {
      out[lane] = {};
      out[lane].amount = in[lane].amount;
      out[lane].energy = in[lane].energy;
      out[lane].heat = in[lane].heat;
      out[lane].material = in[lane].material;
      out[lane].state = in[lane].state;
      if (design().walls_in_conduction()) out[lane].beside_wall = in[lane].beside_wall;
      if (design().freezes()) out[lane].touches = in[lane].touches;
      if (out[lane] != in[lane]) ADD_FAILURE() << "a side-band leaves " << name();
    }
  }
};

// Adds the stages of one phase, in their order.
inline void phase_stages(const Design& design, const StageMaker& make, step::Phase phase, Stages& stages) {
  for (const StageKind kind : stages_of_step(design))
    if (phase_of(kind) == phase) stages.push_back(make(kind, design));
}

inline void source_of(const Design& design, const StageMaker& make, Stages& stages) {
  phase_stages(design, make, step::Phase::source, stages);
}

inline void heat_of(const Design& design, const StageMaker& make, Stages& stages) {
  phase_stages(design, make, step::Phase::heat, stages);
  if (!stages.empty()) stages.push_back(std::make_unique<NoSideBands>(design, stages.back()->kind()));
}

inline void melt_of(const Design& design, const StageMaker& make, Stages& stages) {
  phase_stages(design, make, step::Phase::melt, stages);
}

}  // namespace voxmelt::hwmodel
