// The target reads a whole scene file. Its grid is made small, so that every input takes little time.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  const auto file = fuzz::write("scene.toml", fuzz::text_of(data, size));
  fuzz::try_to([&] { scene::title_of(file); });
  fuzz::try_to([&] { scene::load(file, {"grid.size=[8, 9, 7]"}); });
  return 0;
}
