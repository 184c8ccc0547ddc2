// The target reads a glTF file, voxelised in a small grid.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/mesh_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  voxmelt::fuzz::read_mesh(".glb", data, size);
  return 0;
}
