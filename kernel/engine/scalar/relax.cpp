// Heads relax before the viscous law's spread, if sub-steps are fewer than the state needs.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/automaton/rule/relax.h"
#include "kernel/automaton/rule/viscous.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {

// Finds for each cell in a run how much it levels with its neighbours, and lets all of them do so.
void Reference::relax(rule::Relaxation relaxation, const Volume& volume) {
  const ActiveRows rows(volume);
  const Cells cells(volume);
  std::array<state::Field<std::int32_t>, 8> leveling;
  for (auto& of_direction : leveling) of_direction = state::Field<std::int32_t>(volume.grid);
  state::Field<rule::Relaxing> relaxing(volume.grid);

  const auto for_each_pair = [&](const auto& visit) {
    rows.for_each([&](int x, int y, int z) {
      const state::Slot i = cells.at(x, y, z);
      if (!in_run_[i]) return;
      for (int d = 0; d < 8; ++d) {
        const rule::Direction to = rule::kDirections[d];
        if (!is_open(cells, x, y, z, to)) continue;
        const state::Slot j = cells.at(x + to.dx, y, z + to.dz);
        if (in_run_[j] && !(shut_[i] && shut_[j])) visit(x, y, z, i, j, static_cast<std::size_t>(d));
      }
    });
  };
  for_each_pair([&](int x, int y, int z, state::Slot i, state::Slot j, std::size_t d) {
    const rule::Direction to = rule::kDirections[d];
    const bool diagonal = rule::is_diagonal(static_cast<int>(d));
    const auto levels = [&](state::Slot giver, state::Slot taker, bool set) {
      const rule::Column from = column_of(giver), there = column_of(taker);
      if (set) return 0;
      if (!rule::gives(from, there, diagonal)) return 0;
      const int walls = diagonal ? 0 : blocked_beside(cells, x, y, z, to);
      return rule::leveling(
          rule::conductance(from, volume.amount[giver], there, volume.amount[taker], relaxation),
          rule::slope_factor(rule::bed_rise(from.bed, there.bed), rise_across(cells, x, y, z, to), diagonal,
                             walls),
          std::min(filled_[giver], filled_[taker]), diagonal, relaxation);
    };
    // At most one of them gives.
    leveling[d][i] = levels(i, j, is_set(x, y, z)) + levels(j, i, is_set(x + to.dx, y, z + to.dz));
  });
  for (int stage = 1;; ++stage) {
    rows.for_each([&](int x, int y, int z) {
      const state::Slot i = cells.at(x, y, z);
      const std::int32_t own_head = head_[i] - (y - 2) * rule::kHeadOne;
      if (in_run_[i]) relaxed_[i] = rule::integrated(own_head, relaxing[i].change, stage, relaxation);
    });
    if (stage == relaxation.stages) return;
    state::Field<std::int32_t> taken(volume.grid), given(volume.grid);
    for_each_pair([&](int, int, int, state::Slot i, state::Slot j, std::size_t d) {
      const std::int32_t rise = relaxed_[j] - relaxed_[i];
      if (rise > 0)
        taken[i] += rule::leveled(rise, leveling[d][i], stage, relaxation);
      else
        given[i] += rule::leveled(-rise, leveling[d][i], stage, relaxation);
    });
    rows.for_each([&](int x, int y, int z) {
      const state::Slot i = cells.at(x, y, z);
      relaxing[i].add(taken[i], given[i], stage + 1);
    });
  }
}

}  // namespace voxmelt::scalar
