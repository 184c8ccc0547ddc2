// The state of a simulation at a moment, as Python holds it.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>

#include "python/handle.h"

namespace voxmelt::python {

namespace py = pybind11;

// It keeps its simulation, and no address in it. Once that has changed, it is good for nothing.
struct StateOfHandle {
  py::object owner;           // the simulation
  std::uint64_t changed = 0;  // Handle::changed at that moment

  Use look() const;  // throws std::runtime_error where the simulation has moved on
};

}  // namespace voxmelt::python
