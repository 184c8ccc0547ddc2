// The findings become text: JSON for programs, tables and a plot for people.
#pragma once

#include <string>

#include "measure/suite.h"

namespace voxmelt::measure {

// Writes the JSON. `version` is that of the program that was measured.
std::string bench_json(const Findings& findings, const std::string& version);

// Writes a line for each case of the automaton, below a line of names.
std::string bench_csv(const Findings& findings);

// The tables are in Markdown, each after a line "<!-- table: NAME -->".
std::string short_tables(const Findings& findings);    // machine, scenes, dense, bounds, densebounds, picture
std::string full_tables(const Findings& findings);     // memory, rates, flow, heat, scaling, roofs
std::string picture_tables(const Findings& findings);  // drawing, drawings, grids, films
std::string device_tables(const Findings& findings);   // device, devicesteps, transfers; empty without one

// Draws the roofline plot of the widest instruction set on one thread: operations per byte across, operations
// per second up.
std::string roofline_svg(const Findings& findings);

}  // namespace voxmelt::measure
