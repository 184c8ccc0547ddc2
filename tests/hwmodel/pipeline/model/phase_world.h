// The reference runs one world phase by phase, and shows the state before and after a phase. It serves tests
// that need more than the random worlds of expect_phase.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/hwmodel/pipeline/model/stage_run.h"

namespace voxmelt::hwmodel {

// Calls visit(step, before, after, irradiance) for `phase` of each step, until it returns false.
template <class Visit>
void each_phase(const rule::Parameters& parameters, const state::Volume& start, step::Phase phase, int steps,
                Visit&& visit) {
  run::Simulation simulation(parameters, start, worlds::implementation("reference"));
  visibility::VoxelWalkProvider provider(1);
  step::Irradiance irradiance(start.grid);
  const rule::Heat& heat = parameters.heat;
  const bool radiates = heat.radiates();
  for (int step = 0; step < steps; ++step) {
    const std::uint32_t number = simulation.steps_done();
    if (heat.is_visibility_step(number)) provider.irradiance(simulation.volume(), heat, number, irradiance);
    simulation.begin_step();
    for (const step::Phase each : simulation.phases()) {
      const state::Volume before = simulation.volume();
      simulation.run_phase(each);
      if (each == phase && !visit(number, before, simulation.volume(), radiates ? &irradiance : nullptr))
        return;
    }
    simulation.end_step();
  }
}

struct CellAt {
  int x, y, z;
  friend bool operator==(const CellAt&, const CellAt&) = default;
};

// Returns the first cell in the order of the stream in which two states differ.
inline std::optional<CellAt> first_difference(const Shape& shape, const state::Volume& a,
                                              const state::Volume& b) {
  std::vector<Cell> left(static_cast<std::size_t>(shape.lanes)), right = left;
  for (Place place; place.ordinal < shape.tokens(); place.next(shape)) {
    read_token(a, shape, place, left.data());
    read_token(b, shape, place, right.data());
    for (int lane = 0; lane < shape.lanes; ++lane)
      if (const auto i = static_cast<std::size_t>(lane); left[i] != right[i])
        return CellAt{place.x + lane, place.y, place.z};
  }
  return std::nullopt;
}

}  // namespace voxmelt::hwmodel
