// Phase `excess` of the viscous law settles every run and gives its cells their head and mobility. (The
// paper's law moves its excess in the same sweep as gravity.)
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/viscous.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// Holds the cells bottom .. bottom + n - 1 of a column, with the sums of their amounts, and of amount x heat.
struct Run {
  const Cells& cells;
  state::Volume& volume;
  int x, bottom, z;
  std::int32_t n = 0;
  std::int64_t mass = 0;
  std::uint64_t content = 0;

  state::Slot at(std::int32_t k) const { return cells.at(x, bottom + k, z); }
  std::int32_t amount(std::int32_t k) const { return volume.amount[at(k)]; }
};

Run gathered(const Cells& cells, state::Volume& volume, int x, int bottom, int z) {
  Run run{cells, volume, x, bottom, z};
  std::int32_t next_amount = cells.amount(x, bottom, z);
  while (next_amount > 0 || run.mass > std::int64_t{run.n} * rule::kOne) {
    const std::int32_t top = next_amount;
    run.mass += top;
    run.content += content_of(top, volume.heat[run.at(run.n)]);
    ++run.n;
    if (cells.blocked(x, bottom + run.n, z)) break;
    next_amount = cells.amount(x, bottom + run.n, z);
    if (!rule::run_continues(run.mass, run.n, top, next_amount)) break;
  }
  return run;
}

bool keeps_order(const Run& run) {
  std::int64_t below = 0;
  for (std::int32_t k = 0; k < run.n - 1; ++k) {
    below += run.amount(k);
    if (!rule::keeps_order_at(rule::face_excess(below, k))) return false;
  }
  return run.mass <= std::int64_t{run.n} * rule::kOne;
}

void move_part(const Run& run, std::int32_t from, std::int32_t to, std::int32_t flow, std::int32_t offset) {
  if (flow == 0) return;
  const std::int32_t held = run.amount(to);
  std::uint16_t& h = run.volume.heat[run.at(to)];
  h = static_cast<std::uint16_t>(rule::mixed(
      content_of(held, h) + content_of(flow, run.volume.heat[run.at(from)]), held + flow, offset));
  add(run.volume.amount[run.at(to)], flow);
  add(run.volume.amount[run.at(from)], -flow);
}

// Moves the parts through the faces of the run, upwards and then downwards.
void move_in_order(const Run& run, std::int32_t offset) {
  std::vector<std::int64_t> below;  // for each face: the run's mass below it, before anything moves
  below.reserve(static_cast<std::size_t>(run.n));
  std::int64_t sum = 0;
  for (std::int32_t k = 0; k < run.n - 1; ++k) below.push_back(sum += run.amount(k));
  const auto below_face = [&](std::int32_t k) { return below[k]; };
  for (std::int32_t k = 0; k < run.n - 1; ++k)
    move_part(run, k, k + 1, rule::settles_up(rule::face_excess(below_face(k), k)), offset);
  for (std::int32_t k = run.n - 2; k >= 0; --k)
    move_part(run, k + 1, k, rule::settles_down(run.mass, below_face(k), k), offset);
}

void mix_all(const Run& run, std::int32_t h) {
  for (std::int32_t k = 0; k < run.n; ++k) run.volume.heat[run.at(k)] = static_cast<std::uint16_t>(h);
}

// Moves the heat while the cells still have their old amounts.
void settle_heat(const Run& run, std::int32_t offset) {
  if (keeps_order(run))
    move_in_order(run, offset);
  else
    mix_all(run, rule::mixed(run.content, run.mass, offset));
}

}  // namespace

void Reference::settle(step::Moment moment, Volume& volume, Ledger& ledger) {
  const ActiveRows columns = ActiveRows::columns(volume);
  const Cells cells(volume);
  const bool hot = parameters_.heat.enabled;
  const std::int32_t offset = rule::mixing_dither(moment.step, moment.substep);

  const auto settle_run = [&](int x, int bottom, int z) {
    const Run run = gathered(cells, volume, x, bottom, z);
    if (run.n == 0) return bottom;
    if (hot) settle_heat(run, offset);
    ledger.heat.rounded -= run.content;
    const auto mean = static_cast<std::int32_t>(run.content / run.mass);
    const rule::Column column =
        rule::run_column(run.mass, run.n, rule::bed_head(bottom, cells.bed(x, bottom - 1, z, solid_beds_)),
                         mean, parameters_.flow, moment.substeps, {moment.stages});
    const std::int32_t held = rule::settled_cells(run.mass, run.n);
    const bool shut = rule::is_shut(run.mass, run.n, cells.blocked(x, bottom + run.n, z));
    for (std::int32_t k = 0; k < run.n; ++k) {
      const state::Slot i = run.at(k);
      const std::int32_t amount = rule::settled(run.mass, run.n, k);
      volume.amount[i] = static_cast<std::uint16_t>(amount);
      ledger.heat.rounded += content_of(amount, volume.heat[i]);
      if (amount == 0) volume.heat[i] = 0;
      if (amount == 0) continue;  // emptied: above the surface, no part of the run any more
      in_run_[i] = 1;
      shut_[i] = shut;
      head_[i] = column.head;
      mobility_[i] = column.mobility;
      exposed_[i] = column.exposed;
      dead_[i] = column.dead;
      bed_[i] = column.bed;
      limit_[i] = column.limit;
      filled_[i] = held;
    }
    ledger.limit.add(state::LimitCounts<std::int64_t>{held, column.limited ? held : 0, run.mass,
                                                      column.limited ? run.mass : 0});
    return bottom + run.n;
  };

  in_run_.clear();
  shut_.clear();
  for (int z = 0; z < volume.grid.z; ++z) {
    const ActiveRows::Interval row = columns(0, z);
    for (int x = row.begin; x < row.end; ++x)
      for (int y = 0; y < volume.grid.y; ++y)
        if (!cells.blocked(x, y, z) && cells.blocked(x, y - 1, z)) y = std::max(y, settle_run(x, y, z) - 1);
  }
  settle_masks(columns, volume);
}

}  // namespace voxmelt::scalar
