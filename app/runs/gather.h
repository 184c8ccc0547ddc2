// The outputs of all runs of a sweep are gathered, whoever made them: a table, and a page to look at.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "app/runs/design.h"
#include "app/runs/sweep_folder.h"

namespace voxmelt::app {

// Holds runs that failed in this sweep, and why.
using Failures = std::map<std::string, std::string>;

// Returns the last line that a run has written to its log, or nothing.
std::string last_line_of(const std::filesystem::path& log);

// Writes table.csv and index.html. Returns how many runs are complete.
std::size_t gather(const Plan& plan, const std::vector<PlannedRun>& runs, const SweepFolder& folder,
                   const Failures& failures);

}  // namespace voxmelt::app
