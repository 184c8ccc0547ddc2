// The target reads an OBJ file, voxelised in a small grid.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  voxmelt::fuzz::read_mesh(".obj", data, size);
  return 0;
}
