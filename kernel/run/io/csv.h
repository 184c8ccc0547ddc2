// The books of a run as a table: a row for each moment that is looked at, with columns separated by commas.
#pragma once

#include <filesystem>
#include <string>

#include "kernel/run/io/export.h"

namespace voxmelt::io {

inline constexpr const char* kCsvFile = "steps.csv";

// Returns the names of the columns as a line. docs/output.md explains them.
std::string csv_head();
// Returns a line of numbers. This takes a pass over the state.
std::string csv_row(const Moment& moment);

// Writes steps.csv, with one row.
void export_csv(const Moment& moment, const std::filesystem::path& folder, const Poll& poll);

}  // namespace voxmelt::io
