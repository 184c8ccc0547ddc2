// Every program does the same around its commands. It prepares streams and signals, and turns an error into a
// message and an exit code.
#pragma once

#include <functional>
#include <string>

#include "app/command_line.h"

namespace voxmelt::app {

// Returns the exit code. `introduction` stands at the head of the help. While commands are added, streams and
// signals are still as the caller gave them.
int run_program(const std::string& introduction, const std::function<void(CommandLine&)>& add_commands,
                int argc, char** argv);

}  // namespace voxmelt::app
