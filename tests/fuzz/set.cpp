// The target reads the text behind --set: an assignment a line, on a scene that has most tables.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "tests/fuzz/target.h"

namespace {

constexpr const char* kScene = R"(title = "all tables"
[grid]
size = [8, 9, 7]
[[solid]]
shape = "sphere"
radius = 2
at = [4, 4, 4]
[[liquid]]
shape = "box"
size = [3, 3, 3]
at = [2, 1, 2]
amount = 0.5
[[inert]]
shape = "floor"
thickness = 1
[[vent]]
at = [4, 6, 4]
radius = 1
rate = 0.1
[heat]
gamma = 0.05
[[heat_source]]
at = [8, 12, 4]
power = 100
[heat.air]
exchange = 0.01
[flow]
law = "paper"
[flow.paper]
threshold = 0.2
[camera]
azimuth = 20
[light]
azimuth = 10
[look]
liquid = [0.5, 0.5, 0.5]
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace voxmelt;
  static const auto file = fuzz::write("scene.toml", kScene);
  std::vector<std::string> assignments;
  const std::string_view text = fuzz::text_of(data, size);
  for (std::size_t at = 0; at <= text.size() && assignments.size() < 8;) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    assignments.push_back(fuzz::argument(text.substr(at, end - at)));
    at = end + 1;
  }
  assignments.emplace_back("grid.size=[8, 9, 7]");
  fuzz::try_to([&] { scene::load(file, assignments); });
  return 0;
}
