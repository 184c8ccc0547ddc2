// The target reads an OBJ file, voxelised in a small grid.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  static const auto scene =
      fuzz::write("scene.toml",
                  "[grid]\nsize = [16, 12, 14]\n[[solid]]\nshape = \"mesh\"\n"
                  "file = \"m.obj\"\nheight = 8\nat = [8, 2, 8]\nrotate = [10, 20, 0]\n");
  fuzz::write("m.obj", fuzz::text_of(data, size));
  fuzz::try_to([&] { scene::load(scene, {}); });
  return 0;
}
