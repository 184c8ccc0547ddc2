#include "kernel/automaton/state/digest.h"

#include <algorithm>
#include <cstddef>

namespace voxmelt::state {
namespace {

bool any_of(const std::uint16_t* cells, int count) {
  unsigned bits = 0;
  for (int i = 0; i < count; ++i) bits |= cells[i];
  return bits != 0;
}

}  // namespace

std::uint64_t digest(const Volume& volume) {
  const Grid g = volume.grid;
  std::uint64_t sum = 0;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      const auto solid = volume.solid.row(y, z), liquid = volume.liquid.row(y, z),
                 inert = volume.inert.row(y, z);
      const std::uint16_t *amount = volume.amount.row(y, z), *energy = volume.energy.row(y, z),
                          *heat = volume.heat.row(y, z);
      for (std::size_t w = 0; w < solid.size(); ++w) {
        const int first = static_cast<int>(64 * w), count = std::min(64, g.x - first);
        if ((solid[w] | liquid[w] | inert[w]) == 0 && !any_of(amount + first, count) &&
            !any_of(energy + first, count) && !any_of(heat + first, count))
          continue;
        for (int bit = 0; bit < count; ++bit) {
          const int x = first + bit;
          const std::uint64_t packed = std::uint64_t{amount[x]} | std::uint64_t{energy[x]} << 16 |
                                       std::uint64_t{heat[x]} << 32 | (solid[w] >> bit & 1u) << 48 |
                                       (liquid[w] >> bit & 1u) << 49 | (inert[w] >> bit & 1u) << 50;
          sum += cell_digest(g.index(x, y, z), packed);
        }
      }
    }
  return sum;
}

}  // namespace voxmelt::state
