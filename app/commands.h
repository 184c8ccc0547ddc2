// The subcommands. Each adds itself to its program.
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

// Of the program voxmelt-measure.
void add_bench(CommandLine& program);
void add_accuracy(CommandLine& program);

// Of the program voxmelt-hardware.
void add_verify(CommandLine& program);
void add_explore(CommandLine& program);

// `list WHAT`: `prints` has what this program can name. What others name is never asked of it.
void add_list(CommandLine& program, const std::map<std::string, std::function<void()>>& prints);

}  // namespace voxmelt::app
