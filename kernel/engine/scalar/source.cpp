// Phase `source` lets vents add liquid, and drains and an open border take it.
#include "kernel/automaton/rule/source.h"

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/heat.h"
#include "kernel/engine/scalar/reference.h"
#include "kernel/engine/scalar/region.h"

namespace voxmelt::scalar {
namespace {

// Calls visit(x, y, z) for the non-blocked cells of a region, x fastest.
template <class Visit>
void for_region(const rule::Region& region, const state::Volume& volume, Visit&& visit) {
  for_cells(region, volume.grid, [&](int x, int y, int z) {
    if (!volume.solid.test(x, y, z) && !volume.inert.test(x, y, z)) visit(x, y, z);
  });
}

// Calls visit(x, y, z) for the liquid cells of the border. Inner slices share the ends of each row with it.
template <class Visit>
void for_border(const state::Volume& volume, Visit&& visit) {
  const state::Grid g = volume.grid;
  for (int z = 0; z < g.z; ++z) {
    const bool inner = z > 0 && z < g.z - 1;
    const int stride = inner ? std::max(1, g.x - 1) : 1;
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; x += stride)
        if (volume.liquid.test(x, y, z)) visit(x, y, z);
  }
}

// Takes up to `rate` from a cell that is not blocked.
void drain(int x, int y, int z, rule::Amount rate, state::Volume& volume, state::Ledger& ledger) {
  const state::Slot i = volume.at(x, y, z);
  const std::int32_t taken = rule::drained(volume.amount[i], rate);
  if (taken == 0) return;
  const std::int32_t left = volume.amount[i] - taken;
  const std::int32_t lost = std::max(0, volume.energy[i] - left);
  ledger.mass.removed += taken;
  ledger.energy.removed += lost;
  ledger.heat.removed += content_of(taken, volume.heat[i]);
  add(volume.amount[i], -taken);
  add(volume.energy[i], -lost);
  if (left > 0) return;
  volume.liquid.set(x, y, z, false);
  volume.heat[i] = 0;
}

}  // namespace

void Reference::source(std::uint32_t step, Volume& volume, Ledger& ledger) {
  const bool paper = parameters_.flow.law == rule::Law::paper;

  for (const rule::Vent& vent : parameters_.vents) {
    if (!rule::is_open(vent.from, vent.until, step)) continue;
    for_region(vent.region, volume, [&](int x, int y, int z) {
      const state::Slot i = volume.at(x, y, z);
      const std::int32_t before = volume.amount[i], added = rule::vented(before, vent.rate);
      if (added == 0) return;
      const std::int32_t after = before + added;
      add(volume.amount[i], added);
      volume.liquid.set(x, y, z, true);
      ledger.mass.added += added;

      if (paper) {
        const std::int32_t energy = rule::vented_energy(added, vent.energy);
        add(volume.energy[i], energy);
        ledger.energy.added += energy;
      }
      if (parameters_.heat.enabled) {
        const std::uint64_t brought = content_of(added, vent.temperature);
        const std::uint64_t content = content_of(before, volume.heat[i]) + brought;
        ledger.heat.added += brought;
        mix(volume.heat[i], content, after, rule::dither(step), ledger);
      }
    });
  }

  for (const rule::Drain& one : parameters_.drains) {
    if (!rule::is_open(one.from, one.until, step)) continue;
    for_region(one.region, volume, [&](int x, int y, int z) { drain(x, y, z, one.rate, volume, ledger); });
  }

  if (parameters_.open_border)
    for_border(volume, [&](int x, int y, int z) { drain(x, y, z, rule::kAmountMax, volume, ledger); });
}

}  // namespace voxmelt::scalar
