// Each function here adds a subcommand to its program.
#pragma once

#include <functional>
#include <map>
#include <string>

#include "app/command_line.h"

namespace voxmelt::app {

void add_run(CommandLine& program);
void add_digest(CommandLine& program);
void add_export(CommandLine& program);
void add_render(CommandLine& program);
void add_info(CommandLine& program);
void add_new(CommandLine& program);

// The program voxmelt-measure has these.
void add_bench(CommandLine& program);
void add_accuracy(CommandLine& program);

// The program voxmelt-runs has these.
void add_sweep(CommandLine& program);
void add_plot(CommandLine& program);

// The program voxmelt-hardware has these.
void add_verify(CommandLine& program);
void add_rtl(CommandLine& program);
void add_explore(CommandLine& program);

// Adds `list WHAT`. `prints` has the lists that this program can print. It is never asked for the lists of
// other programs.
void add_list(CommandLine& program, const std::map<std::string, std::function<void()>>& prints);

}  // namespace voxmelt::app
