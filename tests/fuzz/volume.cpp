// The target reads a volume of numbers. The first byte says in which format.
#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/target.h"

namespace {

constexpr std::array kEndings{".npy", ".npz", ".nrrd", ".mha", ".vox"};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  if (size == 0) return 0;
  const std::string name = std::string("v") + kEndings[data[0] % kEndings.size()];
  fuzz::write(name, fuzz::text_of(data + 1, size - 1));
  const auto scene = fuzz::write(
      "scene.toml", "[grid]\nsize = [16, 12, 14]\n[[solid]]\nshape = \"volume\"\nfile = \"" + name + "\"\n");
  fuzz::try_to([&] { scene::load(scene, {}); });
  return 0;
}
