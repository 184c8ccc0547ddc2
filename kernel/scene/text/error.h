// The errors of reading a scene are told apart by type. The program turns each type into an exit code.
#pragma once

#include <stdexcept>

namespace voxmelt::scene {

// Is bad input, already in its final form: "file:line:column: error: what is wrong, what is allowed".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Is thrown if memory or disk is full: exit code 3 of the program.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace voxmelt::scene
