#include "kernel/automaton/state/connectivity.h"

#include <array>
#include <vector>

namespace voxmelt::state {

std::int64_t count_detached(const Volume& volume) {
  const Grid g = volume.grid;
  constexpr std::array<std::array<int, 3>, 6> sides{
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}};
  BitPlane attached(g);
  std::vector<std::array<int, 3>> front;
  const auto attach = [&](int x, int y, int z) {
    if (!volume.solid.test(x, y, z) || attached.test(x, y, z)) return;
    attached.set(x, y, z, true);
    front.push_back({x, y, z});
  };

  // Start from every solid that touches the bottom or an inert cell, and flood through solids.
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        if (!volume.solid.test(x, y, z)) continue;
        bool stands = y == 0;
        for (const auto& [dx, dy, dz] : sides)
          stands =
              stands || (g.contains(x + dx, y + dy, z + dz) && volume.inert.test(x + dx, y + dy, z + dz));
        if (stands) attach(x, y, z);
      }
  while (!front.empty()) {
    const auto [x, y, z] = front.back();
    front.pop_back();
    for (const auto& [dx, dy, dz] : sides)
      if (g.contains(x + dx, y + dy, z + dz)) attach(x + dx, y + dy, z + dz);
  }
  return volume.solid.count() - attached.count();
}

}  // namespace voxmelt::state
