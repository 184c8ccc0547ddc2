// The file report.json says what was run, what it left, and if the books balance. It suffices to repeat the
// run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/options.h"

namespace voxmelt::app {

// Holds wall-clock seconds. Steps, drawing and encoding overlap, so their sum may exceed the total.
struct RunSeconds {
  double update = 0, render = 0;
  double encode = 0;  // pictures to PNG, summed over threads
  double wait = 0;    // steps stood still until pictures were done, the end of the run included
  double total = 0;
  double on_device = 0;  // drawing where the state lies; then the first two have nothing of it
};

// Returns JSON text. `complete` says that every step that was asked for was done, and every frame made.
// Integers too large for JSON readers are written as strings.
std::string report_json(const scene::Scene& scene, const Common& common, const run::Simulation& simulation,
                        const RunSeconds& seconds, bool complete = true);

// Tells if the report.json of this output folder says that the run is complete.
bool says_complete(const std::filesystem::path& folder);
// Returns what a complete run was told, as its report.json has it. Without one there is nothing.
struct Told {
  std::uint64_t steps = 0, seed = 0;
  std::vector<std::string> sets;  // of --set
};
std::optional<Told> told_to(const std::filesystem::path& folder);

// Says what the limit of the mobility withholds, if that is much. Otherwise the text is empty.
std::string limit_text(const state::LimitCounts<state::Sum>& limit, const rule::ViscousLaw& law);

// Warns of that, where a command has no lines of its own for it.
void warn_of_limit(scene::Scene& scene, const Common& common, const run::Simulation& simulation);

// Lists what does not balance, as in "mass +1, heat -3". The text is empty if all ledgers balance.
std::string drift_text(const state::Drift& drift);

}  // namespace voxmelt::app
