// Phase `gravity`, both laws: one ascending sweep over each column. The paper's law also pushes up what does
// not fit (excess); under the viscous law only cells outside a run fall.
#include "kernel/automaton/rule/gravity.h"

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/heat.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// side(x, y, z) says whether that cell counts as a blocked side.
template <class Side>
rule::FallSurroundings surroundings(const Cells& cells, const Side& side, int x, int y, int z,
                                    bool empty_below) {
  const bool wall = side(x - 1, y, z) || side(x + 1, y, z) || side(x, y, z - 1) || side(x, y, z + 1);
  return {wall, empty_below && (wall || cells.blocked(x, y + 1, z))};
}

}  // namespace

void Reference::gravity(std::uint32_t step, Volume& volume, Ledger& ledger) {
  const bool paper = parameters_.flow.law == rule::Law::paper;
  const bool hot = parameters_.heat.enabled;
  const rule::PaperLaw& law = parameters_.flow.paper;
  const std::int32_t offset = rule::dither(step);
  const ActiveRows columns = ActiveRows::columns(volume);  // excess may climb as far as it must
  const Cells cells(volume);  // masks are those of the phase's begin until settle_masks
  // Under the paper's law the sides are those before this step's melt.
  const auto side = [&](int x, int y, int z) {
    return cells.blocked(x, y, z) || (paper && melted_.test(x, y, z));
  };

  // Moves `flow` (and energy) from cell `from` to cell `to`, and mixes their heat.
  const auto transfer = [&](state::Slot from, state::Slot to, std::int32_t flow) {
    if (hot) {
      const std::uint64_t content = std::uint64_t{volume.amount[to]} * volume.heat[to] +
                                    static_cast<std::uint64_t>(flow) * volume.heat[from];
      const std::uint64_t after = std::uint64_t{volume.amount[to]} + static_cast<std::uint64_t>(flow);
      const std::int32_t h = rule::mixed(content, after, offset);
      ledger.heat.rounded +=
          static_cast<state::Sum>(after * static_cast<std::uint64_t>(h)) - static_cast<state::Sum>(content);
      volume.heat[to] = static_cast<std::uint16_t>(h);
    }
    volume.amount[from] = static_cast<std::uint16_t>(volume.amount[from] - flow);
    volume.amount[to] = static_cast<std::uint16_t>(volume.amount[to] + flow);
  };
  const auto cap_energy = [&](state::Slot i) {
    if (volume.energy[i] <= volume.amount[i]) return;
    ledger.energy.capped += volume.energy[i] - volume.amount[i];
    volume.energy[i] = volume.amount[i];
  };

  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y + 1 < volume.grid.y; ++y) {
      const ActiveRows::Interval row = columns(y, z);
      for (int x = row.begin; x < row.end; ++x) {
        const state::Slot low = cells.at(x, y, z), high = cells.at(x, y + 1, z);
        const std::int32_t lower = volume.amount[low], upper = volume.amount[high];
        if (lower + upper == 0 || cells.blocked(x, y, z) || cells.blocked(x, y + 1, z)) continue;

        // Down: liquid falls only into free space. So a cell filled by falling never exceeds 1.
        if (upper > 0 && lower < rule::kOne && (paper || !in_run_[high])) {
          const std::int32_t ready = rule::released(upper, parameters_.flow.fall,
                                                    surroundings(cells, side, x, y + 1, z, lower == 0));
          const std::int32_t flow = rule::fallen(lower, ready);
          if (flow == 0) continue;
          if (paper) {
            const std::int32_t room = lower + flow - volume.energy[low];
            const rule::EnergyMove move = rule::energy_fallen(volume.energy[high], flow, room, law);
            volume.energy[high] = static_cast<std::uint16_t>(volume.energy[high] - move.lost);
            volume.energy[low] = static_cast<std::uint16_t>(volume.energy[low] + move.gained);
            ledger.energy.accelerated += move.gained - move.lost;
          }
          transfer(high, low, flow);
          cap_energy(high);
        } else if (paper && lower > rule::kOne) {  // Up: the piling of highly viscous liquid.
          const std::int32_t flow = rule::pushed_up(lower, upper);
          if (flow == 0) continue;
          const std::int32_t energy = std::min<std::int32_t>(volume.energy[low], flow);
          volume.energy[low] = static_cast<std::uint16_t>(volume.energy[low] - energy);
          volume.energy[high] = static_cast<std::uint16_t>(volume.energy[high] + energy);
          transfer(low, high, flow);
        }
      }
    }
  settle_masks(columns, volume);
  melted_.clear();
}

}  // namespace voxmelt::scalar
