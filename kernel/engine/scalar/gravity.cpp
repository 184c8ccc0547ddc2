// Phase `gravity` is one ascending sweep over each column, in both laws. The paper's law also pushes up the
// amount that does not fit (excess). Under the viscous law only cells outside a run fall.
#include "kernel/automaton/rule/gravity.h"

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/heat.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// Describes the surroundings of a cell. side(x, y, z) tells if that cell counts as a blocked side.
template <class Side>
rule::FallSurroundings surroundings(const Cells& cells, const Side& side, int x, int y, int z,
                                    bool empty_below, bool set) {
  const bool wall = side(x - 1, y, z) || side(x + 1, y, z) || side(x, y, z - 1) || side(x, y, z + 1);
  const bool touches = wall || cells.blocked(x, y + 1, z);
  return {wall, empty_below && touches, set && touches};
}

// Moves liquid between a cell and the one above it, with its energy and heat.
class PairMoves {
 public:
  PairMoves(const rule::Parameters& parameters, std::int32_t offset, state::Volume& volume,
            state::Ledger& ledger)
      : flow_(parameters.flow),
        hot_(parameters.heat.enabled),
        offset_(offset),
        volume_(volume),
        ledger_(ledger) {}

  // Liquid falls down only into free space. So a cell filled by falling never exceeds 1.
  void fall(state::Slot high, state::Slot low, const rule::FallSurroundings& around) {
    const std::int32_t lower = volume_.amount[low];
    const std::int32_t flow = rule::fallen(lower, rule::released(volume_.amount[high], flow_.fall, around));
    if (flow == 0) return;
    if (flow_.law == rule::Law::paper) {
      const std::int32_t room = lower + flow - volume_.energy[low];
      const rule::EnergyMove move = rule::energy_fallen(volume_.energy[high], flow, room, flow_.paper);
      add(volume_.energy[high], -move.lost);
      add(volume_.energy[low], move.gained);
      ledger_.energy.accelerated += move.gained - move.lost;
    }
    transfer(high, low, flow);
    cap_energy(high);
  }

  // Pushes liquid up: the piling of highly viscous liquid.
  void push_up(state::Slot low, state::Slot high) {
    const std::int32_t flow = rule::pushed_up(volume_.amount[low], volume_.amount[high]);
    if (flow == 0) return;
    const std::int32_t energy = std::min<std::int32_t>(volume_.energy[low], flow);
    add(volume_.energy[low], -energy);
    add(volume_.energy[high], energy);
    transfer(low, high, flow);
  }

 private:
  void transfer(state::Slot from, state::Slot to, std::int32_t flow) {
    if (hot_) {
      const std::uint64_t content =
          content_of(volume_.amount[to], volume_.heat[to]) + content_of(flow, volume_.heat[from]);
      mix(volume_.heat[to], content, volume_.amount[to] + flow, offset_, ledger_);
    }
    add(volume_.amount[from], -flow);
    add(volume_.amount[to], flow);
  }
  void cap_energy(state::Slot i) {
    if (volume_.energy[i] <= volume_.amount[i]) return;
    ledger_.energy.capped += volume_.energy[i] - volume_.amount[i];
    volume_.energy[i] = volume_.amount[i];
  }

  const rule::Flow& flow_;
  const bool hot_;
  const std::int32_t offset_;
  state::Volume& volume_;
  state::Ledger& ledger_;
};

}  // namespace

void Reference::gravity(std::uint32_t step, Volume& volume, Ledger& ledger) {
  const bool paper = parameters_.flow.law == rule::Law::paper;
  const ActiveRows columns = ActiveRows::columns(volume);  // excess may climb as far as it must
  const Cells cells(volume);  // masks stay those of the phase's begin until settle_masks
  // Under the paper's law the sides are those before this step's melt.
  const auto side = [&](int x, int y, int z) {
    if (!paper || cells.outside(x, y, z)) return cells.blocked(x, y, z);
    const bool frozen = parameters_.freezes() && frozen_.test(x, y, z);
    return (cells.blocked(x, y, z) && !frozen) || melted_.test(x, y, z);
  };

  PairMoves moves(parameters_, rule::dither(step), volume, ledger);
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y + 1 < volume.grid.y; ++y) {
      const ActiveRows::Interval row = columns(y, z);
      for (int x = row.begin; x < row.end; ++x) {
        const state::Slot low = cells.at(x, y, z), high = cells.at(x, y + 1, z);
        const std::int32_t lower = volume.amount[low], upper = volume.amount[high];
        if (lower + upper == 0 || cells.blocked(x, y, z) || cells.blocked(x, y + 1, z)) continue;

        if (upper > 0 && lower < rule::kOne && (paper || !in_run_[high]))
          moves.fall(high, low, surroundings(cells, side, x, y + 1, z, lower == 0, is_set(x, y + 1, z)));
        else if (paper && lower > rule::kOne)
          moves.push_up(low, high);
      }
    }
  settle_masks(columns, volume);
  melted_.clear();
}

}  // namespace voxmelt::scalar
