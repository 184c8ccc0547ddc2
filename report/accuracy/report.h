// The cases are reported in a JSON file, a table of comma-separated values, a page, and a summary.
#pragma once

#include <string>
#include <vector>

#include "accuracy/case.h"

namespace voxmelt::accuracy {

struct Found {
  const Case* one = nullptr;
  Outcome outcome;
  double seconds = 0;
};

struct Report {
  std::string version, implementation;
  int threads = 1;
  bool quick = false;
  std::vector<std::string> sets;
  std::vector<Found> found;

  bool passed() const;
  int gates() const;   // rows that have a gate
  int missed() const;  // rows that do not pass their gate
};

// The full name of a row is its case and setting, as in "heat_kernel/6 neighbours, gamma 0.3".
std::string json_text(const Report& report);
std::string csv_text(const Report& report);
std::string html_text(const Report& report);
std::string markdown_text(const Report& report);

// Writes a number with as many digits as a reader wants, and a relative error as "1.25 %".
std::string number_text(double value);
std::string error_text(const Row& row);
std::string gate_text(const Row& row);            // "1 %"; "reported" without a gate
std::string speed_text(double cells_per_second);  // "12.5 M"

}  // namespace voxmelt::accuracy
