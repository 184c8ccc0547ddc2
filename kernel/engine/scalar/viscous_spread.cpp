// Phase `spread` of the viscous law lets liquid flow down the difference of free-surface heads.
#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/neighbourhood.h"
#include "kernel/automaton/rule/viscous.h"
#include "kernel/engine/scalar/reference.h"

namespace voxmelt::scalar {
namespace {

// Each axis has its own part of the dither: x, z, and the two diagonals.
constexpr std::array<int, 8> kDitherAxis{0, 0, 1, 1, 2, 3, 3, 2};

// A set cell gives nothing, be it the higher one or the one from which liquid flows back.
bool may_flow(std::int32_t wanted, bool own_is_higher, bool own_set, bool other_set) {
  return !(own_is_higher ? own_set : other_set) && !(wanted > 0 ? own_set : other_set);
}

}  // namespace

// Returns what a cell shows to its neighbours.
rule::Column Reference::shown(const Cells& cells, int x, int y, int z) const {
  const state::Slot i = cells.at(x, y, z);
  if (in_run_[i]) return column_of(i);
  if (cells.blocked(x, y - 1, z))
    return rule::bed_column(rule::bed_head(y, cells.bed(x, y - 1, z, solid_beds_)));
  const state::Slot below = cells.at(x, y - 1, z);
  if (in_run_[below]) return rule::top_column(column_of(below));
  return rule::air_column(y);
}

// Returns how steep the beds of an open pair are across it. At the bottom of a valley they are level.
std::int32_t Reference::rise_across(const Cells& cells, int x, int y, int z, rule::Direction to) const {
  const int nx = x + to.dx, nz = z + to.dz;
  std::int32_t up = 0, down = 0;
  const auto walk = [&](int ax, int az, int bx, int bz) {  // from a to b
    if (cells.blocked(ax, y, az) || cells.blocked(bx, y, bz)) return;
    const std::int32_t a = shown(cells, ax, y, az).bed, b = shown(cells, bx, y, bz).bed;
    std::int32_t& most = b > a ? up : down;
    most = std::max(most, rule::bed_rise(a, b));
  };
  if (to.dx != 0 && to.dz != 0) {
    walk(nx, z, x, nz);
  } else {
    const int ax = to.dz, az = to.dx;  // across
    walk(x - ax, z - az, x, z);
    walk(x, z, x + ax, z + az);
    walk(nx - ax, nz - az, nx, nz);
    walk(nx, nz, nx + ax, nz + az);
  }
  return std::max(up, down) - std::min(up, down);
}

void Reference::viscous_spread(step::Moment moment, Volume& volume, Ledger& ledger) {
  const ActiveRows rows(volume);
  const Cells cells(volume);
  const bool hot = parameters_.heat.enabled;
  const std::int32_t mixing = rule::mixing_dither(moment.step, moment.substep);

  const rule::Relaxation relaxation{moment.stages};
  if (relaxation.relaxes()) relax(relaxation, volume);

  next_.amount = volume.amount;
  next_.heat = volume.heat;
  rows.for_each([&](int x, int y, int z) {
    if (cells.blocked(x, y, z)) return;
    const state::Slot i = cells.at(x, y, z);
    const rule::Column own = shown(cells, x, y, z);
    std::int32_t out = 0, in = 0;
    std::uint64_t content = 0;
    for (int d = 0; d < 8; ++d) {
      const rule::Direction to = rule::kDirections[d];
      const int nx = x + to.dx, nz = z + to.dz;
      if (!is_open(cells, x, y, z, to)) continue;
      const state::Slot j = cells.at(nx, y, nz);
      if (!in_run_[i] && !in_run_[j]) continue;
      if (shut_[i] && shut_[j]) continue;
      const rule::Column there = shown(cells, nx, y, nz);
      const std::int32_t offset =
          rule::pair_dither(moment.step, kDitherAxis[d], y, moment.substep, moment.substeps);
      const bool diagonal = rule::is_diagonal(d);
      const int walls = diagonal ? 0 : blocked_beside(cells, x, y, z, to);
      const std::int32_t wanted =
          rule::flow_between(own, volume.amount[i], there, volume.amount[j], diagonal, offset, walls,
                             relaxed_[i] - relaxed_[j], relaxation, rise_across(cells, x, y, z, to));
      const bool may = may_flow(wanted, own.head > there.head, is_set(x, y, z), is_set(nx, y, nz));
      const std::int32_t given = may ? wanted : 0;
      const std::int32_t taken = std::max(0, -given);
      out += std::max(0, given);
      in += taken;
      content += content_of(taken, volume.heat[j]);
    }
    if (out == 0 && in == 0) return;

    const std::int32_t amount = volume.amount[i] - out + in;
    add(next_.amount[i], in - out);
    if (hot && in > 0) {
      content += content_of(volume.amount[i] - out, volume.heat[i]);
      mix(next_.heat[i], content, amount, mixing, ledger);
    }
  });
  std::swap(volume.amount, next_.amount);
  std::swap(volume.heat, next_.heat);
  settle_masks(rows, volume);
}

}  // namespace voxmelt::scalar
