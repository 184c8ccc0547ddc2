// A sweep is written as a file that makes the same runs elsewhere: a Slurm array, GNU parallel, or make.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "app/runs/design.h"
#include "app/runs/sweep_folder.h"

namespace voxmelt::app {

inline constexpr std::array<std::string_view, 3> kEngines{"slurm", "parallel", "make"};

struct Emitted {
  std::string file;     // in the folder
  std::string command;  // that a user types
};

// Writes the files for an engine. `more` are options of each run, and `per_task` says how many runs a task of
// an array makes, one after the other.
Emitted emit(const std::string& engine, const std::vector<PlannedRun>& runs, const SweepFolder& folder,
             const std::vector<std::string>& more, std::size_t per_task, int threads);

}  // namespace voxmelt::app
