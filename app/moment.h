// A run gives the formats of states what they write.
#pragma once

#include "kernel/run/io/export.h"
#include "kernel/run/simulation.h"

namespace voxmelt::app {

inline io::Moment moment_of(const run::Simulation& simulation) {
  io::Moment moment(simulation.volume());
  moment.ledger = &simulation.ledger();
  moment.step = simulation.steps_done();
  moment.parameters = &simulation.parameters();
  return moment;
}

}  // namespace voxmelt::app
