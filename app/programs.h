// The program is in parts, so that nobody need build the hardware model for a picture. `voxmelt` runs and
// draws. Its other commands are programs beside it, which take its place when they are asked for.
#pragma once

#include <array>
#include <string_view>

namespace voxmelt::app {

#ifndef VOXMELT_VIEW
#define VOXMELT_VIEW 0  // set to 1 by a build that has the libraries of voxmelt-view
#endif

struct Elsewhere {
  std::string_view command, program;
  std::string_view description;  // the command's text in --help of voxmelt
  bool there = true;             // this build has it
  std::string_view brings = {};  // packages of Debian without which a build has it not
};

inline constexpr std::array kElsewhere{
    Elsewhere{"view", "voxmelt-view", "Melt it by hand, in a browser: sources, vents, numbers, camera",
              VOXMELT_VIEW != 0, "libboost-dev libjpeg-dev"},
    Elsewhere{"sweep", "voxmelt-runs", "Make many runs that differ in some keys, and one table of them"},
    Elsewhere{"plot", "voxmelt-runs", "Draw the curves of one run, or of many, as one SVG"},
    Elsewhere{"bench", "voxmelt-measure",
              "Throughput, beside what this machine could do at most and the paper's program"},
    Elsewhere{"accuracy", "voxmelt-measure",
              "The physics: errors beside analytic answers, and the bars that they must keep"},
    Elsewhere{"verify", "voxmelt-hardware",
              "Run the hardware model in lock-step with the software; stop at the first difference"},
    Elsewhere{"rtl", "voxmelt-hardware",
              "Write the pipeline of a scene in SystemVerilog, with a test bench and scripts"},
    Elsewhere{"explore", "voxmelt-hardware",
              "Which hardware is best: all designs by closed form, the best ones simulated and verified"},
};

// Names a list of `list`, and the program that knows it.
struct ListedElsewhere {
  std::string_view what, program;
};
inline constexpr std::array kListedElsewhere{
    ListedElsewhere{"cases", "voxmelt-measure"},    ListedElsewhere{"presets", "voxmelt-hardware"},
    ListedElsewhere{"devices", "voxmelt-hardware"}, ListedElsewhere{"memories", "voxmelt-hardware"},
    ListedElsewhere{"faults", "voxmelt-hardware"},
};

constexpr std::string_view description_of(std::string_view command) {
  for (const Elsewhere& row : kElsewhere)
    if (row.command == command) return row.description;
  return {};
}

// Becomes the program that has the command, and returns only if it is this one. Streams and signals must be
// as the caller gave them. Throws UsageError if that program is not there, and says how to build it.
void become_program(int argc, char** argv);

}  // namespace voxmelt::app
