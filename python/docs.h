// The docstrings of the module are the comments of the public headers (header_docs.py).
#pragma once

#include <string_view>

namespace voxmelt::python {

// Returns the comment on "Scope::name", ending in a zero. It throws std::logic_error where there is none.
const char* doc(std::string_view name);

}  // namespace voxmelt::python
