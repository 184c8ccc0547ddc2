#include "hwmodel/explore/dram_time.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "hwmodel/memory/address_map.h"
#include "hwmodel/memory/ratio.h"

namespace voxmelt::hwmodel::explore {
namespace {

// Tells how often a turn of the bus finds a bank in use. Then the first burst of the new side needs the bank
// of the other side's last burst, for another row.
struct Meetings {
  double of_writes = 0, of_reads = 0;
};

// Counts the cycles that the data bus loses when it turns from reads to writes and back.
double turn_cycles(const memory::Parameters& p, const Meetings& meetings) {
  const int reads_to_writes = p.read_to_write;
  const int writes_to_reads = p.wtr_s + p.cl + p.read_more;
  // If the other side's row lies in the same bank, it must be closed, and this side's row opened.
  const int read = p.cl + p.read_more + p.beats() - p.cwl - p.write_more;  // command to command
  const int open = p.rp + p.rcd;
  const int for_writes = std::max(0, p.rtp + open - read - p.read_to_write);
  const int for_reads = std::max(0, p.wr + open - p.wtr_s);
  return reads_to_writes + writes_to_reads + for_writes * meetings.of_writes + for_reads * meetings.of_reads;
}

}  // namespace

double meeting(double bursts, const memory::Parameters& p) {
  // All bursts of a stretch lie in one bank of every group.
  const std::int64_t stretch = p.row_bytes() / memory::kBurst * p.groups * p.channels;
  const std::int64_t period = std::int64_t{p.banks} * p.ranks * p.banks;  // stretches until banks repeat
  const double stretches_between = ratio(bursts, stretch), below = std::floor(stretches_between);
  const auto share = [&](std::int64_t stretches) {
    std::int64_t met = 0;
    for (std::int64_t at = 0; at < period; ++at) {
      const std::int64_t other = at + (stretches % period + period) % period;
      const memory::Location a = memory::locate(at * stretch * memory::kBurst, p);
      const memory::Location b = memory::locate(other * stretch * memory::kBurst, p);
      met += stretches != 0 && a.bank == b.bank && a.rank == b.rank ? 1 : 0;
    }
    return ratio(met, period);
  };
  const double part = stretches_between - below;
  const std::int64_t whole = std::llround(below);
  return (1 - part) * share(whole) + part * share(whole + 1);
}

namespace {

// Says how often the two sides meet. A batch of writes begins when `policy.batch` of them wait. So its first
// write lies so far behind, and its last one next to nothing. Bursts of the feeds lie in banks at random.
Meetings meetings_of(const StreamWork& work, const memory::Parameters& p, const Placement& placement,
                     const memory::Policy& policy) {
  constexpr double kBurstBits = 8.0 * memory::kBurst;
  const auto window = static_cast<double>(work.cycles - work.lag), lag = static_cast<double>(work.lag);
  const std::vector<Behind> as_lag{{ratio(work.read_bits, kBurstBits) * lag / window, 1}};
  Meetings meetings;
  for (const Behind& one : placement.behind.empty() ? as_lag : placement.behind) {
    meetings.of_writes += one.share * meeting(one.bursts + policy.batch * p.channels, p);
    meetings.of_reads += one.share * meeting(one.bursts, p);
  }
  const double state = ratio(work.read_bits, std::max<std::int64_t>(1, work.read_bits + work.fed_bits));
  meetings.of_writes = state * meetings.of_writes + (1 - state) / p.banks;
  meetings.of_reads = state * meetings.of_reads + (1 - state) / p.banks;
  return meetings;
}

double turn_of(const StreamWork& work, const memory::Parameters& p, const Placement& placement,
               const memory::Policy& policy) {
  return turn_cycles(p, meetings_of(work, p, placement, policy));
}

}  // namespace

std::string beyond_bounds(const memory::Parameters& p, int clock_mhz) {
  std::string beyond;
  const auto limit = [&](int value, int most, const char* unit) {
    if (value > most)
      beyond += fmt::format("{}{} {} (at most {})", beyond.empty() ? "" : ", ", value, unit, most);
  };
  limit(p.interface_cycles * 1000 / p.mhz, kMostNanoseconds, "ns through controller and pins");
  limit(p.channels, kMostChannels, "channels");
  limit(p.ranks, 1, "ranks");
  limit(clock_mhz, kMostClock, "MHz");
  if (p.by_bank) beyond += fmt::format("{}refreshes of banks", beyond.empty() ? "" : ", ");
  return beyond;
}

std::int64_t allowed_error(std::int64_t cycles, const memory::Parameters& p, int clock_mhz) {
  return std::llround(kBound * static_cast<double>(cycles) + bus_times(p, clock_mhz, 0).refresh_stop);
}

std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& p, int clock_mhz,
                       const Placement& placement, const memory::Policy& policy) {
  if (placement.work.columns.empty()) return work.cycles;
  bool waits = true;
  const double turn = turn_of(work, p, placement, policy);
  return cycles_by_columns(placement.work, bus_times(p, clock_mhz, turn), policy, waits);
}

std::vector<std::int64_t> cycles_on(const StreamWork& work, const memory::Parameters& p,
                                    const std::vector<int>& clocks, const Placement& placement) {
  std::vector<std::int64_t> cycles(clocks.size(), work.cycles);
  if (placement.work.columns.empty()) return cycles;
  bool waits = true;
  const memory::Policy policy;
  const double turn = turn_of(work, p, placement, policy);
  for (std::size_t i = clocks.size(); i-- > 0;)
    cycles[i] = cycles_by_columns(placement.work, bus_times(p, clocks[i], turn), policy, waits);
  return cycles;
}

}  // namespace voxmelt::hwmodel::explore
