#include "kernel/state/digest.h"

namespace voxmelt::state {

std::uint64_t digest(const Volume& volume) {
  const Grid g = volume.grid;
  std::uint64_t sum = 0;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        const Slot i = volume.at(x, y, z);
        const std::uint64_t packed = std::uint64_t{volume.amount[i]} | std::uint64_t{volume.energy[i]} << 16 |
                                     std::uint64_t{volume.temperature[i]} << 32 |
                                     std::uint64_t{volume.solid.test(x, y, z)} << 48 |
                                     std::uint64_t{volume.liquid.test(x, y, z)} << 49 |
                                     std::uint64_t{volume.inert.test(x, y, z)} << 50;
        sum += cell_digest(g.index(x, y, z), packed);
      }
  return sum;
}

}  // namespace voxmelt::state
