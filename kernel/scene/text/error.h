// The errors of reading a scene, by kind. The program turns each kind into an exit code.
#pragma once

#include <stdexcept>

namespace voxmelt::scene {

// Bad input, already in its final form: "file:line:column: error: what is wrong, what is allowed".
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Out of memory or disk: exit code 3 of the program.
class ResourceError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace voxmelt::scene
