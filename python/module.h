// What each source adds to the module.
#pragma once

#include <pybind11/pybind11.h>

namespace voxmelt::python {

void add_records(pybind11::module_& m);
void add_simulation(pybind11::module_& m);
void add_state(pybind11::module_& m);

}  // namespace voxmelt::python
