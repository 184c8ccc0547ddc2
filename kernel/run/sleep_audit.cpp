#include "kernel/run/sleep_audit.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "kernel/automaton/state/difference.h"
#include "kernel/automaton/state/ledger_difference.h"

namespace voxmelt::run {
namespace {

using state::to_string;
using std::to_string;

step::Tuning with_sleep(step::Tuning tuning, bool sleep) {
  tuning.sleep = sleep;
  return tuning;
}

std::string cell_text(int x, int y, int z) {
  return "cell (" + to_string(x) + ", " + to_string(y) + ", " + to_string(z) + ")";
}

bool same_matter(const state::Volume& a, const state::Volume& b, int x, int y, int z) {
  const state::Slot slot = a.at(x, y, z);
  return a.amount[slot] == b.amount[slot] && a.liquid.test(x, y, z) == b.liquid.test(x, y, z);
}

// Returns a cell around this one that sleeps.
std::optional<SleepsBeside> sleeper_around(const state::Grid& grid, const step::AwakeTiles& awake, int x,
                                           int y, int z) {
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (grid.contains(x + dx, y + dy, z + dz) && !awake.test(x + dx, y + dy, z + dz))
          return SleepsBeside{x + dx, y + dy, z + dz, x, y, z};
  return {};
}

}  // namespace

std::optional<SleepsBeside> sleeps_beside_change(const state::Volume& before, const state::Volume& after,
                                                 const step::AwakeTiles& awake) {
  if (awake.tiles.empty()) return {};
  const state::Grid& g = after.grid;
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y)
      for (int x = 0; x < g.x; ++x) {
        if (same_matter(before, after, x, y, z)) continue;
        if (const auto found = sleeper_around(g, awake, x, y, z)) return found;
      }
  return {};
}

bool begins_flow(const std::vector<step::Phase>& phases, std::size_t i) {
  const auto last = [&](step::Phase phase) {
    return phases.size() - 1 - (std::find(phases.rbegin(), phases.rend(), phase) - phases.rbegin());
  };
  return i == std::min(last(step::Phase::gravity), last(step::Phase::spread));
}

std::string SleepsBeside::text() const {
  return cell_text(x, y, z) + " sleeps in the next step, though " +
         cell_text(changed_x, changed_y, changed_z) + " beside it was changed";
}

std::string SleepFault::text() const {
  if (kind == Kind::beside) return field;
  const std::string values = field + " expected " + to_string(expected) + ", is " + to_string(actual);
  if (kind == Kind::books) return "no cell differs, but the books do: " + values;
  return cell_text(x, y, z) + ": " + values + (slept ? "; its tile was to sleep in this step" : "");
}

SleepAudit::SleepAudit(const rule::Parameters& parameters, const state::Volume& start,
                       std::uint32_t first_step, const step::Implementation& implementation,
                       step::Tuning tuning)
    : sleeping_(parameters, start, implementation, with_sleep(tuning, true)),
      awake_(parameters, start, implementation, with_sleep(tuning, false)) {
  sleeping_.begin_at(first_step);
  awake_.begin_at(first_step);
}

std::optional<SleepFault> SleepAudit::step() {
  const step::AwakeTiles awake = sleeping_.awake();
  count(awake);
  sleeping_.begin_step();
  awake_.begin_step();
  const std::vector<step::Phase> phases = sleeping_.phases();
  state::Volume before;
  for (std::size_t i = 0; i < phases.size(); ++i) {
    if (begins_flow(phases, i)) before = sleeping_.volume();
    sleeping_.run_phase(phases[i]);
    awake_.run_phase(phases[i]);
    if (auto fault = compare(phases[i], awake)) return fault;
  }
  const std::uint32_t step = sleeping_.step_number();
  sleeping_.end_step();
  awake_.end_step();
  const auto found = sleeps_beside_change(before, sleeping_.volume(), sleeping_.awake());
  if (!found) return {};
  return SleepFault{.kind = SleepFault::Kind::beside,
                    .step = step,
                    .phase = phases.back(),
                    .x = found->x,
                    .y = found->y,
                    .z = found->z,
                    .field = found->text(),
                    .slept = true};
}

std::optional<SleepFault> SleepAudit::compare(step::Phase phase, const step::AwakeTiles& awake) const {
  SleepFault fault;
  fault.step = sleeping_.step_number();
  fault.phase = phase;
  if (const auto d = state::first_difference(awake_.volume(), sleeping_.volume())) {
    fault.x = d->x;
    fault.y = d->y;
    fault.z = d->z;
    fault.field = d->field;
    fault.expected = d->expected;
    fault.actual = d->actual;
    fault.slept = !awake.test(d->x, d->y, d->z);
    return fault;
  }
  if (const auto d = state::first_difference(awake_.ledger(), sleeping_.ledger())) {
    fault.kind = SleepFault::Kind::books;
    fault.field = d->term;
    fault.expected = d->expected;
    fault.actual = d->actual;
    return fault;
  }
  return {};
}

void SleepAudit::count(const step::AwakeTiles& awake) {
  const int words = (volume().grid.x + 63) / 64;
  const std::uint64_t all = ~std::uint64_t{0} >> (64 - words);  // bits beyond the grid mean nothing
  tiles_ += words * static_cast<std::int64_t>(awake.tiles.size());
  for (const std::uint64_t row : awake.tiles) asleep_ += std::popcount(~row & all);
}

}  // namespace voxmelt::run
