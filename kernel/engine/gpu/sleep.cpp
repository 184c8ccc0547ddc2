// The lists of who is awake on a device are made here (program/lists.cl), and tests ask here what sleeps.
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/engine/gpu/stepper.h"

namespace voxmelt::gpu {
namespace {

// The numbers of a brick stand in the order of program/lists.cl.
enum Moment : std::uint8_t { moved, warm, restless, matter, seen, heats, falls, spreads, woken, listed };
static_assert(listed + 1 == kMoments);

}  // namespace

// Nothing sleeps in the step that follows.
void Stepper::forget_moments() {
  device_->clear(*moments_, sizeof(std::int32_t) * kMoments * shape_.bricks.cells());
  for (Buffer* field : {&pattern_, &transient_})
    if (*field) device_->clear(**field, static_cast<std::size_t>(shape_.cells));
  if (moment_ > kLastMoment) moment_ = 0;
  awake_ = givers_ = columns_listing_ = falls_ = {};
  all_changed_ = true;
  if (run_) {
    device_->clear(*run_, 2 * static_cast<std::size_t>(shape_.cells));
    device_->clear(*limits_, limit_bytes());
    device_->clear(*standing_, book_bytes());
  }
  device_->run(Kernel::find_matter, groups_,
               {constants_.get(), flags_.get(), amount_.now.get(), moments_.get(), next_moment()});
}

// Lists the bricks that are awake for heat and melt, and those for gravity. A side that melts counts as one
// in that step, so gravity looks at all that has changed since this list was made a step ago, and not since
// the last gravity.
void Stepper::list_awake() {
  counts_.swap(other_counts_);
  const std::int32_t now = next_moment(), all = awake_.all || !sleep_ ? 1 : 0;
  device_->run(Kernel::list_awake, groups_,
               {constants_.get(), moments_.get(), full_.get(), columns_.get(), counts_.get(),
                other_counts_.get(), awake_.since, all, now});
  awake_known_ = falls_known_ = !awake_.all;
  awake_ = {now, false};
  falls_from_ = all != 0 ? 0 : now;
  falls_since_ = now;
}

// Lists the bricks in which the paper's law looks for cells that give.
void Stepper::list_givers() {
  counts_.swap(other_counts_);
  const std::int32_t now = next_moment(), all = givers_.all || !sleep_ ? 1 : 0;
  device_->run(Kernel::list_givers, groups_,
               {constants_.get(), moments_.get(), near_.get(), counts_.get(), other_counts_.get(),
                givers_.since, all, now});
  givers_known_ = !givers_.all;
  givers_ = {now, false};
}

// Runs whose mobilities were for another number of sub-steps or stages are settled again.
void Stepper::list_columns(step::Cadence cadence) {
  counts_.swap(other_counts_);
  if (std::exchange(substeps_, cadence.substeps) != cadence.substeps)
    columns_listing_.all = givers_.all = true;
  if (std::exchange(stages_, cadence.stages) != cadence.stages) columns_listing_.all = givers_.all = true;
  const std::int32_t all = columns_listing_.all || !sleep_ ? 1 : 0;
  device_->run(Kernel::list_columns, groups_,
               {constants_.get(), moments_.get(), columns_.get(), counts_.get(), other_counts_.get(),
                columns_listing_.since, all});
  columns_listing_ = {next_moment(), false};
}

// Relaxed heads come from many cells, so nothing sleeps then.
void Stepper::list_pairs(step::Cadence cadence) {
  counts_.swap(other_counts_);
  const std::int32_t now = next_moment(), all = givers_.all || !sleep_ || cadence.stages > 1 ? 1 : 0;
  device_->run(Kernel::list_pairs, groups_,
               {constants_.get(), moments_.get(), full_.get(), near_.get(), counts_.get(),
                other_counts_.get(), givers_.since, all, now});
  givers_known_ = !givers_.all && cadence.stages == 1;
  givers_ = {now, false};
}

void Stepper::list_falls() {
  counts_.swap(other_counts_);
  const std::int32_t now = next_moment();
  device_->run(Kernel::list_falls, groups_,
               {constants_.get(), moments_.get(), columns_.get(), counts_.get(), other_counts_.get(),
                falls_.since, now});
  falls_from_ = falls_.all || !sleep_ ? 0 : now;
  falls_since_ = now;
  falls_known_ = !falls_.all;
  falls_ = {now, false};
}

std::size_t Stepper::book_bytes() const {
  return sizeof(std::int64_t) * kTerms * static_cast<std::size_t>(groups_);
}
std::size_t Stepper::limit_bytes() const {
  return 4 * sizeof(std::int64_t) * static_cast<std::size_t>(shape_.grid.x) *
         static_cast<std::size_t>(shape_.grid.z);
}

std::vector<std::int32_t> Stepper::read_moments() {
  auto& moments = in_flight(std::vector<std::int32_t>(kMoments * shape_.bricks.cells()));
  device_->read(*moments_, moments.data(), sizeof(std::int32_t) * moments.size());
  std::vector<std::int32_t> all = moments;
  in_flight_.reset();
  return all;
}

// Calls visit(n, last) for the bricks of the grid, where last(moment, brick) is a number of a brick.
template <class Visit>
void Stepper::for_each_brick(const Visit& visit) {
  const std::vector<std::int32_t> all = read_moments();
  const state::Grid& bricks = shape_.bricks;
  const auto last = [&](Moment moment, std::int64_t n) {
    return all[static_cast<std::size_t>(moment * static_cast<std::int64_t>(bricks.cells()) + n)];
  };
  for (int z = 1; z < bricks.z - 1; ++z)
    for (int y = 1; y < bricks.y - 1; ++y)
      for (int x = 1; x < bricks.x - 1; ++x) visit(static_cast<std::int64_t>(bricks.index(x, y, z)), last);
}

// Only those numbers come of which something is told.
void Stepper::fetch_changes() {
  std::vector<std::int32_t> moments(2 * shape_.bricks.cells());
  static_assert(moved == 0 && warm == 1);
  device_->read(*moments_, moments.data(), sizeof(std::int32_t) * moments.size());
  fetched_ = std::move(moments);
  fetched_at_ = moment_;
}

// A brick whose heat might change at another dither is told, too.
void Stepper::tell_changes(state::ChangedBricks& changed) {
  using Changed = state::ChangedBricks;
  if (std::exchange(all_changed_, false) || fetched_.empty()) {
    told_at_ = fetched_at_;
    return changed.mark_all();
  }
  const state::Grid& bricks = shape_.bricks;
  const auto tell = [&](Changed::Part part, Moment moment, int x, int y, int z) {
    if (fetched_[moment * bricks.cells() + bricks.index(x, y, z)] <= told_at_) return;
    const std::uint64_t word = std::uint64_t{1} << ((x - 1) * kBrickX / 64);
    changed.mark(part, word, (y - 1) * kBrickY / state::kBrickSide, (z - 1) * kBrickZ / state::kBrickSide);
  };
  for (int z = 1; z < bricks.z - 1; ++z)
    for (int y = 1; y < bricks.y - 1; ++y)
      for (int x = 1; x < bricks.x - 1; ++x) {
        tell(Changed::kMatter, moved, x, y, z);
        tell(Changed::kHeat, warm, x, y, z);
      }
  told_at_ = fetched_at_;
}

Stepper::Work Stepper::work() {
  Work work;
  const std::int64_t plane = std::int64_t{shape_.bricks.x} * shape_.bricks.y;
  for_each_brick([&](std::int64_t n, const auto& last) {
    const auto holds = [&](std::int64_t k) {
      return last(matter, k) != 0 && last(matter, k) >= last(seen, k);
    };
    bool beside = false;
    for (const std::int64_t k : {-1, 0, 1})
      for (const std::int64_t dx : {-1, 0, 1}) beside = beside || holds(n + k * plane + dx);
    work.with_matter += holds(n) ? 1 : 0;
    work.beside_matter += beside ? 1 : 0;
    work.heat += last(heats, n) >= awake_.since ? 1 : 0;
    work.gravity += holds(n) && last(falls, n) >= falls_since_ ? 1 : 0;
    work.spread += last(spreads, n) >= givers_.since ? 1 : 0;
    work.giving += last(listed, n) > givers_.since ? 1 : 0;
  });
  return work;
}

void Stepper::audit_sleep() {
  audits_ = true;
  sleep_ = false;
}

void Stepper::find_fault(const char* phase, std::int64_t brick) {
  if (fault_.empty())
    fault_ = std::string("brick ") + std::to_string(brick) + " sleeps in " + phase + ", and changes";
}

// A cell that could change at another dither counts as one that has.
void Stepper::audit_heat() {
  if (!awake_known_) return;
  for_each_brick([&](std::int64_t n, const auto& last) {
    const bool changed = last(warm, n) > awake_.since || last(woken, n) > awake_.since;
    if (changed && last(heats, n) < awake_.since) find_fault("heat or melt", n);
  });
}

// A fall wakes the brick where it goes, and excess the one into which it climbs.
void Stepper::audit_gravity() {
  if (!falls_known_) return;
  const std::int32_t now = moment_;
  const int row = shape_.bricks.x;
  for_each_brick([&](std::int64_t n, const auto& last) {
    if (last(moved, n) != now || last(falls, n) >= falls_since_) return;
    if (last(moved, n - row) != now && last(moved, n + row) != now) find_fault("gravity", n);
  });
}

void Stepper::audit_spread() {
  if (!givers_known_) return;
  for_each_brick([&](std::int64_t n, const auto& last) {
    if (last(restless, n) > givers_.since && last(spreads, n) < givers_.since) find_fault("spread", n);
  });
}

}  // namespace voxmelt::gpu
