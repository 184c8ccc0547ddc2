// Tells where values of a field have changed: in which words of 64 cells of which rows.
#pragma once

#include <cstdint>
#include <vector>

namespace voxmelt::state {

struct ChangedRow {
  int y = 0, z = 0;
  std::uint64_t words = 0;  // a bit for each word along x
};
using ChangedRows = std::vector<ChangedRow>;  // a row may come more than once

}  // namespace voxmelt::state
