// The target reads an STL file, voxelised in a small grid.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  voxmelt::fuzz::read_mesh(".stl", data, size);
  return 0;
}
