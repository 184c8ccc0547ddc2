// Phase `melt` turns hot solids into liquid. The extra `reheat` gives hot liquid its energy back.
#include <cstdint>

#include "kernel/automaton/rule/heat.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {

void Reference::melt(Volume& volume, Ledger& ledger) {
  if (!parameters_.heat.enabled) return;
  const bool paper = parameters_.flow.law == rule::Law::paper;
  const std::int32_t reheat = parameters_.flow.paper.reheat;
  melted_.clear();

  ActiveRows(volume).for_each([&](int x, int y, int z) {
    const state::Slot i = volume.at(x, y, z);
    if (!rule::melts(volume.heat[i], parameters_.material)) return;
    if (volume.solid.test(x, y, z)) {
      volume.solid.set(x, y, z, false);
      volume.liquid.set(x, y, z, true);
      if (!paper) return;
      melted_.set(x, y, z, true);
      volume.energy[i] = volume.amount[i];
      ledger.energy.melted += volume.amount[i];
    } else if (paper && reheat > 0 && volume.liquid.test(x, y, z)) {
      const std::int32_t gained = rule::scaled(volume.amount[i] - volume.energy[i], reheat);
      add(volume.energy[i], gained);
      ledger.energy.reheated += gained;
    }
  });
}

}  // namespace voxmelt::scalar
