// Phase `excess` of the viscous law: settle every run and give its cells their head and mobility.
// (The paper's law moves its excess in the same sweep as gravity.)
#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/viscous.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {

void Reference::settle(step::Moment moment, Volume& volume, Ledger& ledger) {
  const ActiveRows columns = ActiveRows::columns(volume);
  const Cells cells(volume);
  const bool hot = parameters_.heat.enabled;
  const std::int32_t offset = rule::mixing_dither(moment.step, moment.substep);

  const auto settle_run = [&](int x, int bottom, int z) {
    // Gather the run.
    std::int64_t mass = 0;
    std::uint64_t content = 0;
    std::int32_t n = 0;
    std::int32_t next_amount = cells.amount(x, bottom, z);
    while (next_amount > 0 || mass > std::int64_t{n} * rule::kOne) {
      const state::Slot i = cells.at(x, bottom + n, z);
      const std::int32_t top = next_amount;
      mass += top;
      content += static_cast<std::uint64_t>(top) * volume.heat[i];
      ++n;
      if (cells.blocked(x, bottom + n, z)) break;
      next_amount = cells.amount(x, bottom + n, z);
      if (!rule::run_continues(mass, n, top, next_amount)) break;
    }
    if (n == 0) return bottom;

    // Settle it: one heat for the whole run, amounts full from the bottom.
    const std::int32_t h = hot ? rule::mixed(content, static_cast<std::uint64_t>(mass), offset) : 0;
    ledger.heat.rounded += static_cast<state::Sum>(mass) * h - static_cast<state::Sum>(content);
    const bool on_inert = bottom > 0 && volume.inert.test(x, bottom - 1, z);
    const std::int32_t bed =
        rule::bed_head(bottom, on_inert ? cells.amount(x, bottom - 1, z) : rule::kBedHalf);
    const rule::Column column = rule::run_column(mass, n, bed, h, parameters_.flow, moment.substeps);
    std::int64_t held = 0;  // cells of the run that hold something
    for (std::int32_t k = 0; k < n; ++k) {
      const state::Slot i = cells.at(x, bottom + k, z);
      const std::int32_t amount = rule::settled(mass, n, k);
      volume.amount[i] = static_cast<std::uint16_t>(amount);
      volume.heat[i] = static_cast<std::uint16_t>(h);
      if (amount == 0) continue;  // emptied: above the surface, no part of the run any more
      in_run_[i] = 1;
      head_[i] = column.head;
      mobility_[i] = column.mobility;
      exposed_[i] = column.exposed;
      dead_[i] = column.dead;
      bed_[i] = column.bed;
      limit_[i] = column.limit;
      ++held;
    }
    ledger.limit.add(
        state::LimitCounts<std::int64_t>{held, column.limited ? held : 0, mass, column.limited ? mass : 0});
    return bottom + n;
  };

  in_run_.clear();
  for (int z = 0; z < volume.grid.z; ++z) {
    const ActiveRows::Interval row = columns(0, z);
    for (int x = row.begin; x < row.end; ++x)
      for (int y = 0; y < volume.grid.y; ++y)
        if (!cells.blocked(x, y, z) && cells.blocked(x, y - 1, z)) y = std::max(y, settle_run(x, y, z) - 1);
  }
  settle_masks(columns, volume);
}

}  // namespace voxmelt::scalar
