#include "kernel/scene/memory.h"

#include <fmt/format.h>

#include <fstream>
#include <limits>
#include <locale>
#include <string>

#include "kernel/scene/text/error.h"

namespace voxmelt::scene {
namespace {

// Returns the kernel's MemAvailable. Without it no grid is refused.
std::uint64_t available_bytes() {
  std::ifstream file("/proc/meminfo");
  file.imbue(std::locale::classic());
  std::string key, unit;
  std::uint64_t kibibytes = 0;
  while (file >> key >> kibibytes) {
    if (key == "MemAvailable:") return kibibytes * 1024;
    std::getline(file, unit);
  }
  return std::numeric_limits<std::uint64_t>::max();
}

}  // namespace

std::uint64_t needed_bytes(state::Grid grid) {
  // Even an empty grid takes memory: three masks, the walls (and sides), the page tables. Half a byte per
  // cell is enough.
  return static_cast<std::uint64_t>(grid.cells()) / 2;
}

void check_memory(state::Grid grid, const Place& place) {
  const std::uint64_t needed = needed_bytes(grid), available = available_bytes();
  if (needed > available)
    throw ResourceError(
        fmt::format("{}: error: grid.size = [{}, {}, {}] needs {} bytes of memory, {} are available",
                    place.text(), grid.x, grid.y, grid.z, needed, available));
}

}  // namespace voxmelt::scene
