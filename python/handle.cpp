#include "python/handle.h"

#include <stdexcept>
#include <string>

namespace voxmelt::python {

Use::Use(Handle& handle, Access access)
    : handle_(handle), outermost_(handle.user == std::thread::id()), looks_allowed_(handle.looks_allowed) {
  if (!outermost_ && handle.user != std::this_thread::get_id())
    throw std::runtime_error("another thread uses this simulation; one at a time may");
  const bool changes = access == Access::step || access == Access::change;
  if (!outermost_ && (changes || !looks_allowed_))
    throw std::runtime_error("this simulation is in the middle of another call");
  if (changes && handle.views > 0)
    throw pybind11::buffer_error(
        std::to_string(handle.views) +
        " views of this simulation's fields are in use; delete them, or copy fields");
  if (changes) ++handle.changed;
  handle.user = std::this_thread::get_id();
  handle.looks_allowed = access == Access::look || access == Access::step;
}

Use::~Use() {
  if (outermost_) handle_.user = std::thread::id();
  handle_.looks_allowed = looks_allowed_;
}

}  // namespace voxmelt::python
