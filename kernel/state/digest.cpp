#include "kernel/state/digest.h"

namespace voxmelt::state {

std::uint64_t digest(const Volume& volume) {
  const Grid g = volume.grid;
  std::uint64_t sum = 0;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      const auto solid = volume.solid.row(y, z), liquid = volume.liquid.row(y, z),
                 inert = volume.inert.row(y, z);
      const std::uint16_t *amount = volume.amount.row(y, z), *energy = volume.energy.row(y, z),
                          *temperature = volume.temperature.row(y, z);
      for (int x = 0; x < g.x; ++x) {
        const std::size_t w = static_cast<std::size_t>(x) / 64;
        const int bit = x % 64;
        const std::uint64_t packed = std::uint64_t{amount[x]} | std::uint64_t{energy[x]} << 16 |
                                     std::uint64_t{temperature[x]} << 32 | (solid[w] >> bit & 1u) << 48 |
                                     (liquid[w] >> bit & 1u) << 49 | (inert[w] >> bit & 1u) << 50;
        sum += cell_digest(g.index(x, y, z), packed);
      }
    }
  return sum;
}

}  // namespace voxmelt::state
