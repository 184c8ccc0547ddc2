// report.json: what was run, what it left, and whether the books balance. It suffices to repeat the run.
#pragma once

#include <string>

#include "app/options.h"

namespace voxmelt::app {

struct RunSeconds {
  double update = 0, render = 0, total = 0;
};

// JSON text; integers too large for JSON readers are written as strings.
std::string report_json(const scene::Scene& scene, const Common& common, const run::Simulation& simulation,
                        const RunSeconds& seconds);

// What does not balance, as in "mass +1, heat -3"; empty when all ledgers balance.
std::string drift_text(const state::Drift& drift);

}  // namespace voxmelt::app
