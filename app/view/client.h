// A client is a page that is open.
#pragma once

#include <cstdint>

namespace voxmelt::view {

using Client = std::uint64_t;

}  // namespace voxmelt::view
