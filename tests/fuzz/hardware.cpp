// The target reads a file for --hw, and the text behind --set hw.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hwmodel/machine/presets/presets.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  const std::string_view text = fuzz::text_of(data, size);
  const auto file = fuzz::write("hw.toml", text);
  for (const auto runs : {hwmodel::Runs::pipeline, hwmodel::Runs::caster, hwmodel::Runs::machine})
    fuzz::try_to([&] { hwmodel::load_preset(file, {}, runs); });
  const std::string line = fuzz::argument(text.substr(0, text.find('\n')));
  fuzz::try_to([&] { hwmodel::load_preset({}, {line}, hwmodel::Runs::machine); });
  return 0;
}
