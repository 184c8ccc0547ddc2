// Worlds of the viscous law for single stages have a hostile volume of a given size, and run phase by phase.
#pragma once

#include <utility>

#include "tests/hwmodel/pipeline/model/stage_run.h"

namespace voxmelt::hwmodel {

struct ViscousWorld {
  Design design;
  run::Simulation simulation;
  step::Moment moment{0};                  // moment of the last phase
  state::BitPlane set{design.shape.grid};  // by the last phase melt

  ViscousWorld(worlds::Random& random, const state::Grid& grid, int lanes)
      : ViscousWorld(hostile(random, grid, lanes)) {}

  // A world of vaults, instead of a hostile volume.
  static ViscousWorld of_vaults(worlds::Random& random, const state::Grid& grid, int lanes) {
    const Design design{freezing_parameters(random, rule::Law::viscous, grid), {grid, lanes}};
    state::Volume start(grid);
    worlds::put_vaults(random, start, design.hot());
    return {design, start};
  }

  ViscousWorld(const Design& the_design, const state::Volume& start)
      : design(the_design), simulation(design.parameters, start, worlds::implementation("reference")) {}

  explicit ViscousWorld(const std::pair<Design, state::Volume>& begin)
      : ViscousWorld(begin.first, begin.second) {}

  static std::pair<Design, state::Volume> hostile(worlds::Random& random, const state::Grid& grid,
                                                  int lanes) {
    Design design{freezing_parameters(random, rule::Law::viscous, grid), {grid, lanes}};
    state::Volume start = volume_of_materials(random, design.parameters, grid);
    return {design, std::move(start)};
  }

  // Runs a whole step of the reference, and calls at(phase, state before it) after each phase.
  template <class At>
  void step(At&& at) {
    simulation.begin_step();
    for (const step::Phase phase : simulation.phases()) {
      const state::Volume before = simulation.volume();
      if (phase == step::Phase::melt) set = set_places(design.parameters, before);
      moment = simulation.moment();
      simulation.run_phase(phase);
      at(phase, before);
    }
    simulation.end_step();
  }
};

inline state::Grid small_grid(worlds::Random& random) {
  return {random.between(1, 20), random.between(1, 9), random.between(1, 6)};
}

}  // namespace voxmelt::hwmodel
