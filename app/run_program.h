// What every program does around its commands: it prepares streams and signals, and an error becomes a
// message and an exit code.
#pragma once

#include <functional>
#include <string>

#include "app/command_line.h"

namespace voxmelt::app {

// Returns the exit code. Who asks for help sees `introduction`. While commands are added, streams and signals
// are still as the caller gave them.
int run_program(const std::string& introduction, const std::function<void(CommandLine&)>& add_commands,
                int argc, char** argv);

}  // namespace voxmelt::app
