// Every error ends a command in the same way: with one line, and an exit code.
#pragma once

#include <exception>
#include <string>

namespace voxmelt::app {

struct Ending {
  std::string message;
  int code;  // an ExitCode
};

// Says how a command ends that has thrown this.
Ending ending_of(const std::exception_ptr& error);

}  // namespace voxmelt::app
