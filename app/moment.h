// A run gives the formats of states what they write.
#pragma once

#include "app/version.h"
#include "kernel/run/io/export.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

namespace voxmelt::app {

inline io::Moment moment_of(const run::Simulation& simulation, const scene::Scene& scene) {
  io::Moment moment(simulation.volume());
  moment.ledger = &simulation.ledger();
  moment.step = simulation.steps_done();
  moment.parameters = &simulation.parameters();
  moment.version = version_number();
  moment.scene = scene.name;
  return moment;
}

}  // namespace voxmelt::app
