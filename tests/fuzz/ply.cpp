// The target reads a PLY file, voxelised in a small grid.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  voxmelt::fuzz::read_mesh(".ply", data, size);
  return 0;
}
