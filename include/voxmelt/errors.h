/// @file
/// Everything that goes wrong has a type here. Each what() is one complete line for the user.
#pragma once

#include <stdexcept>

namespace voxmelt {

/// Is the common base of everything that voxmelt throws on purpose. A std::logic_error is a bug in voxmelt.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The caller gave something wrong: a file, an override, or a number out of its range. The message names the
/// place, the fault and what is allowed: "scene.toml:12:8: error: vent.0.rate = 2 exceeds 1, ...".
class InputError : public Error {
 public:
  using Error::Error;
};

/// A file or folder cannot be written. The message names it and the system's reason.
class OutputError : public Error {
 public:
  using Error::Error;
};

/// Memory or disk space is used up.
class ResourceError : public Error {
 public:
  using Error::Error;
};

/// A stop was requested before the work was done.
class Stopped : public Error {
 public:
  Stopped() : Error("stopped") {}
};

}  // namespace voxmelt
