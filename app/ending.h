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

// Returns true after a device was lost: its driver's threads may still work. Then the program ends without
// giving back what they use.
bool ends_at_once();

}  // namespace voxmelt::app
