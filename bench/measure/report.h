// The findings as text: JSON for programs, tables and a plot for people.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "bench/measure/suite.h"

namespace voxmelt::measure {

// `version` is that of the program that was measured.
std::string bench_json(const Findings& findings, const std::string& version);

// Tables in Markdown, each after a line "<!-- table: NAME -->".
std::string short_tables(const Findings& findings);    // machine, scenes, dense, bounds, densebounds, picture
std::string full_tables(const Findings& findings);     // memory, rates, flow, heat, scaling, roofs
std::string picture_tables(const Findings& findings);  // drawing, drawings, grids, films

// Roofline plot of the widest instruction set on one thread: operations per byte across, operations per
// second up.
std::string roofline_svg(const Findings& findings);

std::string size_text(std::size_t bytes);                         // "2 MiB"
std::string three_digits(double value);                           // "1.23", "0.034", "1234"
std::string or_dash(const std::optional<double>& value);          // three digits, or a dash
std::string percent_or_dash(const std::optional<double>& value);  // "12 %", or a dash
std::string milliseconds(double seconds);                         // three digits
std::string threads_text(int threads);                            // "1 thread", "2 threads"

}  // namespace voxmelt::measure
