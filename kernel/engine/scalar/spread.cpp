// Phase `spread` of the paper's law (Eqs. 7-20) has two sub-phases. `pattern` chooses the directions that
// each cell gives to. In `apply` every cell gathers the gifts of its neighbours.
#include "kernel/automaton/rule/spread.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "kernel/automaton/rule/heat.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// Returns the share of its amount and energy that cell (x, y, z) gives to direction d of its pattern.
std::int32_t share_of(const rule::Flow& flow, std::int32_t heat, std::uint8_t pattern, int d) {
  if (flow.paper.use_table) return flow.paper.table[pattern][d];
  return rule::thermal_share(flow.paper.share, heat, flow);
}

// Is what a cell gives by its pattern.
struct Gift {
  std::int32_t amount = 0, energy = 0;
};
class Gifts {
 public:
  Gifts(const rule::Flow& flow, const Cells& cells, const state::Volume& volume,
        const state::Field<std::uint8_t>& pattern)
      : flow_(flow), cells_(cells), volume_(volume), pattern_(pattern) {}

  // Returns the part of its energy that a gift keeps in contact with what is below the cell.
  std::int32_t alpha(int x, int y, int z) const {
    return rule::contact_alpha(cells_.blocked(x, y - 1, z), cells_.inert(x, y - 1, z), flow_.paper);
  }
  Gift given(int x, int y, int z, int d) const {
    const state::Slot i = cells_.at(x, y, z);
    const std::uint8_t pattern = pattern_[i];
    if (!(pattern >> d & 1u)) return {};
    const std::int32_t cap = rule::flow_cap(flow_.paper.neighbours);
    const bool diagonal = rule::is_diagonal(d);
    const std::int32_t share = share_of(flow_, volume_.heat[i], pattern, d);
    const std::int32_t f = rule::shared(volume_.amount[i], share, cap, diagonal);
    const std::int32_t e = std::min(f, rule::shared(volume_.energy[i], share, cap, diagonal));
    const bool printed = flow_.paper.reading == rule::EnergyReading::printed;
    return {f, printed ? rule::scaled(e, alpha(x, y, z)) : e};
  }

  // Sums all that a cell gives and takes. `content` is amount x heat of the part that it takes.
  struct Balance {
    Gift out, in;
    std::uint64_t content = 0;
  };
  Balance of(int x, int y, int z) const {
    Balance all;
    for (int d = 0; d < flow_.paper.neighbours; ++d) {
      const Gift mine = given(x, y, z, d);
      all.out.amount += mine.amount;
      all.out.energy += mine.energy;
      const int nx = x + rule::kDirections[d].dx, nz = z + rule::kDirections[d].dz;
      if (!cells_.liquid(nx, y, nz)) continue;
      const Gift theirs = given(nx, y, nz, rule::kOpposite[d]);
      all.in.amount += theirs.amount;
      all.in.energy += theirs.energy;
      all.content += content_of(theirs.amount, volume_.heat[cells_.at(nx, y, nz)]);
    }
    return all;
  }

 private:
  const rule::Flow& flow_;
  const Cells& cells_;
  const state::Volume& volume_;
  const state::Field<std::uint8_t>& pattern_;
};

}  // namespace

void Reference::find_patterns(std::uint32_t step, const Volume& volume, const ActiveRows& rows) {
  const Cells cells(volume);
  const rule::Flow& flow = parameters_.flow;
  const rule::PaperLaw& law = flow.paper;
  const std::int32_t cap = rule::flow_cap(law.neighbours);

  rows.for_each([&](int x, int y, int z) {
    std::uint8_t& pattern = pattern_[cells.at(x, y, z)];
    pattern = 0;
    if (!cells.liquid(x, y, z) || is_set(x, y, z)) return;
    if (law.support && cells.air(x, y - 1, z)) return;

    const std::int32_t margin = rule::spread_margin(cells.energy(x, y, z), law);
    if (margin < 0) return;
    const std::int32_t a = cells.amount(x, y, z);
    const std::int32_t share = rule::thermal_share(law.share, cells.heat(x, y, z), flow);
    const std::int32_t axis_flow = law.use_table ? 0 : rule::shared(a, share, cap, false);
    std::uint8_t available = 0;
    for (int d = 0; d < law.neighbours; ++d) {
      const rule::Direction to = rule::kDirections[d];
      if (!is_open(cells, x, y, z, to)) continue;
      const bool diagonal = rule::is_diagonal(d);
      if (rule::receives(a, axis_flow, cells.amount(x + to.dx, y, z + to.dz), margin, diagonal, law))
        available = static_cast<std::uint8_t>(available | 1u << d);
    }

    // All subsets of the available directions are equally likely (section 4.2.2).
    if (available == 0) return;
    const std::uint32_t block = rule::random_block_index(x, y, z, volume.grid.x, volume.grid.y);
    pattern = available & rule::random_byte(rule::random_block(keys_, step, block), x);
  });
}

void Reference::spread(std::uint32_t step, Volume& volume, Ledger& ledger) {
  const ActiveRows rows(volume);
  find_patterns(step, volume, rows);

  const Cells cells(volume);
  const Gifts gifts(parameters_.flow, cells, volume, pattern_);
  const bool printed = parameters_.flow.paper.reading == rule::EnergyReading::printed;
  const bool hot = parameters_.heat.enabled;
  const std::int32_t offset = rule::dither(step);

  // The cells outside the active rows do not change, so this starts from a copy.
  next_.amount = volume.amount;
  next_.energy = volume.energy;
  next_.heat = volume.heat;
  rows.for_each([&](int x, int y, int z) {
    if (cells.blocked(x, y, z)) return;
    const state::Slot i = cells.at(x, y, z);
    auto [out, in, content] = gifts.of(x, y, z);
    if (out.amount == 0 && in.amount == 0) return;

    const std::int32_t amount = volume.amount[i] - out.amount + in.amount;
    add(next_.amount[i], in.amount - out.amount);

    // Friction takes 1 - alpha of the arriving energy. Energy never exceeds the amount.
    const std::int32_t gained = printed ? in.energy : rule::scaled(in.energy, gifts.alpha(x, y, z), offset);
    const std::int32_t energy = volume.energy[i] - out.energy + gained;
    next_.energy[i] = static_cast<std::uint16_t>(std::min(energy, amount));
    ledger.energy.dissipated += in.energy - gained;
    ledger.energy.capped += std::max(0, energy - amount);

    if (hot && in.amount > 0) {
      content += content_of(volume.amount[i] - out.amount, volume.heat[i]);
      mix(next_.heat[i], content, amount, offset, ledger);
    }
  });
  std::swap(volume.amount, next_.amount);
  std::swap(volume.energy, next_.energy);
  std::swap(volume.heat, next_.heat);
  settle_masks(rows, volume);
}

}  // namespace voxmelt::scalar
