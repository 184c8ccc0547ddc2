// The subcommands. Each adds itself to the program.
#pragma once

#include "app/command_line.h"

namespace voxmelt::app {

void add_run(CommandLine& program);
void add_digest(CommandLine& program);
void add_export(CommandLine& program);
void add_render(CommandLine& program);
void add_bench(CommandLine& program);
void add_accuracy(CommandLine& program);
void add_verify(CommandLine& program);
void add_explore(CommandLine& program);
void add_info(CommandLine& program);
void add_list(CommandLine& program);

}  // namespace voxmelt::app
