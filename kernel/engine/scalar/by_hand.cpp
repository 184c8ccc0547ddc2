#include "kernel/engine/scalar/by_hand.h"

#include <cstdint>
#include <utility>

#include "kernel/engine/scalar/cells.h"
#include "kernel/engine/scalar/region.h"

namespace voxmelt::scalar {
namespace {

// Collects the rows of changed cells. Cells come row by row.
class Rows {
 public:
  void add(int x, int y, int z) {
    if (rows_.empty() || rows_.back().y != y || rows_.back().z != z) rows_.push_back({y, z, 0});
    rows_.back().words |= std::uint64_t{1} << (x / 64);
  }
  state::ChangedRows take() { return std::move(rows_); }

 private:
  state::ChangedRows rows_;
};

}  // namespace

bool meets(const rule::Region& region, const state::Grid& grid) {
  bool any = false;
  for_cells(region, grid, [&](int, int, int) { any = true; });
  return any;
}

state::ChangedRows pour(const rule::Region& region, rule::Temperature temperature,
                        const rule::Parameters& parameters, state::Volume& volume, state::Ledger& ledger) {
  Rows rows;
  for_cells(region, volume.grid, [&](int x, int y, int z) {
    if (!Cells(volume).air(x, y, z)) return;
    const state::Slot i = volume.at(x, y, z);
    volume.liquid.set(x, y, z, true);
    volume.amount[i] = rule::kOne;
    ledger.mass.added += rule::kOne;
    if (parameters.flow.law == rule::Law::paper) {
      volume.energy[i] = rule::kOne;
      ledger.energy.added += rule::kOne;
    }
    if (parameters.heat.enabled) {
      volume.heat[i] = temperature;
      ledger.heat.added += content_of(rule::kOne, temperature);
    }
    rows.add(x, y, z);
  });
  return rows.take();
}

state::ChangedRows carve(const rule::Region& region, state::Volume& volume, state::Ledger& ledger) {
  Rows rows;
  for_cells(region, volume.grid, [&](int x, int y, int z) {
    if (!Cells(volume).matter(x, y, z)) return;
    const state::Slot i = volume.at(x, y, z);
    ledger.mass.removed += volume.amount[i];
    ledger.energy.removed += volume.energy[i];
    ledger.heat.removed += content_of(volume.amount[i], volume.heat[i]);
    volume.solid.set(x, y, z, false);
    volume.liquid.set(x, y, z, false);
    volume.amount[i] = volume.energy[i] = volume.heat[i] = 0;
    if (!volume.material.empty()) volume.material[i] = 0;
    rows.add(x, y, z);
  });
  return rows.take();
}

}  // namespace voxmelt::scalar
