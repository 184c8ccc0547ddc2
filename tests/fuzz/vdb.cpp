// The target reads a file of OpenVDB. Its helper is another process, which VOXMELT_VDB names: whatever
// becomes of that, we go on with voxels or a message.
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  if (std::getenv("VOXMELT_VDB") == nullptr) fuzz::found("VOXMELT_VDB names no helper");
  static const auto scene = fuzz::write(
      "scene.toml", "[grid]\nsize = [16, 12, 14]\n[[solid]]\nshape = \"volume\"\nfile = \"v.vdb\"\n");
  fuzz::write("v.vdb", fuzz::text_of(data, size));
  fuzz::try_to([&] { scene::load(scene, {}); });
  return 0;
}
