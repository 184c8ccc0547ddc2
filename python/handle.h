// A simulation as Python holds it, and who may use it at a moment.
#pragma once

#include <pybind11/pybind11.h>
#include <voxmelt/voxmelt.h>

#include <cstdint>
#include <filesystem>
#include <thread>

namespace voxmelt::python {

// All of it but the simulation is read and written with the GIL held.
struct Handle {
  Handle(const std::filesystem::path& scene, const Options& options) : simulation(scene, options) {}

  Simulation simulation;
  std::thread::id user;       // thread that is in a call, if any
  bool looks_allowed = true;  // that call may be interrupted by looks of the same thread
  int views = 0;              // arrays that point into the state
  std::uint64_t changed = 0;  // calls that changed the state
};

enum class Access {
  look,    // reads the state
  draw,    // has a picture, and may not be interrupted by other calls
  step,    // changes the state, and is interrupted by looks between two steps
  change,  // changes the state
};

// Lends the simulation to a call. The library leaves this to its callers: one thread at a time, no change
// amid a call, no change below a view. Here all of it is an exception. It is made and ends with the GIL held.
class Use {
 public:
  // Throws std::runtime_error, and pybind11::buffer_error where views are left.
  Use(Handle& handle, Access access);
  ~Use();
  Use(const Use&) = delete;
  Use& operator=(const Use&) = delete;

  Simulation* operator->() const { return &handle_.simulation; }

 private:
  Handle& handle_;
  bool outermost_, looks_allowed_;
};

}  // namespace voxmelt::python
