// report.json: what was run, what it left, and whether the books balance. It suffices to repeat the run.
#pragma once

#include <filesystem>
#include <string>

#include "app/options.h"

namespace voxmelt::app {

// Wall-clock seconds. Steps, drawing and encoding overlap, so their sum may exceed the total.
struct RunSeconds {
  double update = 0, render = 0;
  double encode = 0;  // of pictures to PNG, summed over threads
  double wait = 0;    // that the steps stood still until pictures were done, the end of the run included
  double total = 0;
};

// JSON text; `complete`: every step that was asked for was done, and every frame made. Integers too large for
// JSON readers are written as strings.
std::string report_json(const scene::Scene& scene, const Common& common, const run::Simulation& simulation,
                        const RunSeconds& seconds, bool complete = true);

// Does the report.json of this output folder say that the run is complete?
bool says_complete(const std::filesystem::path& folder);

// What the limit of the mobility withholds, where that is much; else empty.
std::string limit_text(const state::LimitCounts<state::Sum>& limit);

// What does not balance, as in "mass +1, heat -3"; empty when all ledgers balance.
std::string drift_text(const state::Drift& drift);

}  // namespace voxmelt::app
