// What was found, for programs and for people.
#pragma once

#include <string>

#include "bench/measure/suite.h"

namespace voxmelt::measure {

// `version`: of the program that was measured.
std::string bench_json(const Findings& findings, const std::string& version);

// Tables in Markdown, each after a line "<!-- table: NAME -->": machine, rates, flow, heat, paper, scaling,
// roofs.
std::string tables_markdown(const Findings& findings);

// Roofline plot: operations per byte across, operations per second up.
std::string roofline_svg(const Findings& findings);

std::string size_text(std::size_t bytes);  // "2 MiB"

// "1.2", "0.034", "1234": three digits that matter.
std::string three_digits(double value);

}  // namespace voxmelt::measure
