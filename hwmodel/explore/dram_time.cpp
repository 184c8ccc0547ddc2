#include "hwmodel/explore/dram_time.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/memory/address_map.h"
#include "hwmodel/memory/ratio.h"

namespace voxmelt::hwmodel::explore {
namespace {

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

// Returns the share of the time lost to refresh. In every tREFI the rank closes, is refreshed, and opens a
// row.
double refresh_share(const memory::Parameters& p) { return ratio(p.rtp + p.rp_all + p.rfc + p.rcd, p.refi); }

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

double burst_cycles(double reads, double writes, const Meetings& meetings, const memory::Parameters& p,
                    const memory::Policy& policy) {
  double cycles = (reads + writes) * p.beats() * p.columns_of_request() / p.channels;
  if (reads > 0 && writes > 0)
    cycles += std::min(reads, writes) / p.channels / policy.batch * turn_cycles(p, meetings);
  return cycles / (1 - refresh_share(p));
}

namespace {

std::int64_t cycles_at(const StreamWork& work, const memory::Parameters& p, int clock_mhz,
                       const Placement& placement, const memory::Policy& policy, bool& waits) {
  // While the first tokens are under way, the memory is only read. Then it is read and written, and at last
  // it is only written.
  constexpr double kBurstBits = 8.0 * memory::kBurst;
  const double window = static_cast<double>(work.cycles - work.lag), lag = static_cast<double>(work.lag);
  const double alone = std::min(lag, window), both = window - alone, rest = lag - alone;
  const double reads = ratio(work.read_bits + work.fed_bits, kBurstBits);
  const double writes = ratio(work.written_bits, kBurstBits);
  const double clocks = ratio(clock_mhz, p.mhz);
  // A batch of writes begins when `policy.batch` of them wait. So its first write lies so far behind, and its
  // last one next to nothing. Bursts of the feeds lie in banks at random.
  Meetings meetings;
  const double state = ratio(work.read_bits, std::max(1.0, kBurstBits * reads));
  const double lag_bursts = ratio(work.read_bits, kBurstBits) * lag / window;
  const std::vector<Behind> as_lag{{lag_bursts, 1}};
  for (const Behind& one : placement.behind.empty() ? as_lag : placement.behind) {
    meetings.of_writes += one.share * meeting(one.bursts + policy.batch, p);
    meetings.of_reads += one.share * meeting(one.bursts, p);
  }
  meetings.of_writes = state * meetings.of_writes + (1 - state) / p.banks;
  meetings.of_reads = state * meetings.of_reads + (1 - state) / p.banks;
  if (!placement.work.columns.empty()) {
    const double burst = burst_cycles(1, 0, meetings, p, policy), turn = turn_cycles(p, meetings);
    return cycles_by_columns(
        placement.work,
        {clocks * burst, clocks * (burst + turn / p.channels / policy.batch / (1 - refresh_share(p))),
         clocks * (p.rcd + p.cl + p.read_more + p.beats() * p.columns_of_request() + p.interface_cycles)},
        policy, waits);
  }
  const auto segment = [&](double cycles, bool reading, bool writing) {
    const double share = cycles / window;
    return std::max(cycles, clocks * burst_cycles(reading ? reads * share : 0, writing ? writes * share : 0,
                                                  meetings, p, policy));
  };
  const double first =
      clocks * (p.rcd + p.cl + p.read_more + p.beats() * p.columns_of_request() + p.interface_cycles);
  return std::llround(first + segment(alone, true, false) + segment(both, true, true) + rest +
                      segment(alone, false, true));
}

}  // namespace

std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& p, int clock_mhz,
                       const Placement& placement, const memory::Policy& policy) {
  bool waits = true;
  return cycles_at(work, p, clock_mhz, placement, policy, waits);
}

std::vector<std::int64_t> cycles_on(const StreamWork& work, const memory::Parameters& p,
                                    const std::vector<int>& clocks, const Placement& placement) {
  std::vector<std::int64_t> cycles(clocks.size());
  bool waits = true;
  for (std::size_t i = clocks.size(); i-- > 0;)
    cycles[i] = cycles_at(work, p, clocks[i], placement, {}, waits);
  return cycles;
}

}  // namespace voxmelt::hwmodel::explore
