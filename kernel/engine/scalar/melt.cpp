// Phase `melt` turns hot solids into liquid. The extra `reheat` gives hot liquid its energy back. Cold liquid
// freezes where it is full and touches something, and is set elsewhere.
#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

bool touches_blocked(const Cells& cells, int x, int y, int z) {
  return std::any_of(rule::kFaceAxes.begin(), rule::kFaceAxes.end(), [&](const rule::Offset& d) {
    return cells.blocked(x + d.dx, y + d.dy, z + d.dz) || cells.blocked(x - d.dx, y - d.dy, z - d.dz);
  });
}

}  // namespace

void Reference::melt(Volume& volume, Ledger& ledger) {
  if (!parameters_.heat.enabled) return;
  if (parameters_.freezes()) find_frozen(volume);
  const bool paper = parameters_.flow.law == rule::Law::paper;
  const std::int32_t reheat = parameters_.flow.paper.reheat;
  melted_.clear();

  ActiveRows(volume).for_each([&](int x, int y, int z) {
    const state::Slot i = volume.at(x, y, z);
    const int material = volume.material.empty() ? 0 : volume.material[i];
    if (!materials_.melts(volume.heat[i], material)) return;
    if (volume.solid.test(x, y, z)) {
      volume.solid.set(x, y, z, false);
      volume.liquid.set(x, y, z, true);
      if (material != 0) become_first(volume, i, ledger.heat);
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
  if (parameters_.freezes()) freeze(volume, ledger);
}

// A cell of another material has melted. It goes on as the first one.
void Reference::become_first(Volume& volume, state::Slot i, state::HeatLedger& ledger) const {
  const std::int32_t before = volume.heat[i], after = materials_.melted(before, volume.material[i]);
  ledger.melted += std::int64_t{after - before} * volume.amount[i];
  volume.heat[i] = static_cast<rule::Temperature>(after);
  volume.material[i] = 0;
}

// Finds the cells that freeze, and those that are set, before any mask changes.
void Reference::find_frozen(const Volume& volume) {
  const Cells cells(volume);
  frozen_.clear();
  set_.clear();
  ActiveRows(volume).for_each([&](int x, int y, int z) {
    if (!cells.liquid(x, y, z) || !rule::is_cold(cells.heat(x, y, z), parameters_.material)) return;
    const bool freezes = rule::is_full(cells.amount(x, y, z)) && touches_blocked(cells, x, y, z);
    (freezes ? frozen_ : set_).set(x, y, z, true);
  });
}

void Reference::freeze(Volume& volume, Ledger& ledger) {
  ActiveRows(volume).for_each([&](int x, int y, int z) {
    if (!frozen_.test(x, y, z)) return;
    const state::Slot i = volume.at(x, y, z);
    volume.solid.set(x, y, z, true);
    volume.liquid.set(x, y, z, false);
    ledger.energy.frozen += volume.energy[i];
    volume.energy[i] = 0;
  });
}

}  // namespace voxmelt::scalar
