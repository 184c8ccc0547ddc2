// The target reads a GeoTIFF of heights, drawn over a small grid.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  static const auto scene = fuzz::write("scene.toml",
                                        "[grid]\nsize = [9, 40, 11]\n[[inert]]\nshape = \"heightfield\"\n"
                                        "file = \"h.tif\"\nvertical_scale = 0.0001\nbase = 1\n[[vent]]\n"
                                        "at = [4, 36, 4]\nradius = 1\nrate = 0.1\n");
  fuzz::write("h.tif", fuzz::text_of(data, size));
  fuzz::try_to([&] { scene::load(scene, {}); });
  return 0;
}
