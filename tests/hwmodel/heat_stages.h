// The stages of the phases source, heat and melt, as make_step puts them together.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "tests/hwmodel/phase_world.h"

namespace voxmelt::hwmodel {

// Stands behind a phase: a cell that leaves it brings no side-bands, but what conduction tells gravity.
class NoSideBands final : public Stage {
 public:
  NoSideBands(const Design& design, std::string phase)
      : Stage("no side-bands", std::move(phase), design, 0) {}

 private:
  void advance(const Cell* in, Cell* out) override {
    for (int lane = 0; lane < lanes(); ++lane) {
      out[lane] = {};
      out[lane].amount = in[lane].amount;
      out[lane].energy = in[lane].energy;
      out[lane].heat = in[lane].heat;
      out[lane].state = in[lane].state;
      if (design().walls_in_conduction()) out[lane].beside_wall = in[lane].beside_wall;
      if (out[lane] != in[lane]) ADD_FAILURE() << "a side-band leaves the phase " << phase();
    }
  }
};

inline void source_of(const Design& design, Stages& stages, FedStage*&) {
  if (!design.parameters.vents.empty() || !design.parameters.drains.empty())
    stages.push_back(make_source(design));
}

inline void heat_of(const Design& design, Stages& stages, FedStage*& fed) {
  const rule::Heat& heat = design.parameters.heat;
  if (!heat.enabled) return;
  stages.push_back(make_conduction(design));
  if (heat.neighbours >= 18) stages.push_back(make_edge_conduction(design));
  if (heat.neighbours >= 26) stages.push_back(make_corner_conduction(design));
  if (heat.convection > 0) stages.push_back(make_convection(design));
  if (heat.radiation || heat.air) {
    std::unique_ptr<FedStage> exchange = make_exchange(design);
    if (heat.radiation) fed = exchange.get();
    stages.push_back(std::move(exchange));
  }
  stages.push_back(std::make_unique<NoSideBands>(design, "heat"));
}

inline void melt_of(const Design& design, Stages& stages, FedStage*&) {
  if (design.hot()) stages.push_back(make_melt(design));
}

}  // namespace voxmelt::hwmodel
