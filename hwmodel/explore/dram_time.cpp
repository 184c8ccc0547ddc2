#include "hwmodel/explore/dram_time.h"

#include <algorithm>
#include <cmath>

namespace voxmelt::hwmodel::explore {
namespace {

// Cycles of the data bus that are lost when the sides turn, there and back.
double turn_cycles(const memory::Parameters& p) {
  const int reads_to_writes = p.read_to_write;
  const int writes_to_reads = p.wtr_s + p.cl + p.read_more;
  // Where the other side's row lies in the same bank, it must be opened. Rows of streams lie in banks at
  // random.
  const int read = p.cl + p.read_more + p.beats() - p.cwl - p.write_more;  // command to command
  const int open = p.rp + p.rcd;
  const int for_writes = std::max(0, p.rtp + open - read - p.read_to_write);
  const int for_reads = std::max(0, p.wr + open - p.wtr_s);
  return reads_to_writes + writes_to_reads + static_cast<double>(for_writes + for_reads) / p.banks;
}

// Of every tREFI: the rank closes, is refreshed, and opens a row.
double refresh_share(const memory::Parameters& p) {
  return static_cast<double>(p.rtp + p.rp_all + p.rfc + p.rcd) / p.refi;
}

}  // namespace

double burst_cycles(double reads, double writes, const memory::Parameters& p, const memory::Policy& policy) {
  double cycles = (reads + writes) * p.beats() * p.columns_of_request() / p.channels;
  if (reads > 0 && writes > 0) cycles += std::min(reads, writes) / p.channels / policy.batch * turn_cycles(p);
  return cycles / (1 - refresh_share(p));
}

std::int64_t cycles_on(const StreamWork& work, const memory::Parameters& p, int clock_mhz,
                       const memory::Policy& policy) {
  // While the first tokens are under way it is only read; then both; at last it is only written.
  constexpr double kBurstBits = 8.0 * memory::kBurst;
  const double window = static_cast<double>(work.cycles - work.lag), lag = static_cast<double>(work.lag);
  const double alone = std::min(lag, window), both = window - alone, rest = lag - alone;
  const double reads = static_cast<double>(work.read_bits + work.fed_bits) / kBurstBits;
  const double writes = static_cast<double>(work.written_bits) / kBurstBits;
  const double ratio = static_cast<double>(clock_mhz) / p.mhz;
  const auto segment = [&](double cycles, bool reading, bool writing) {
    const double share = cycles / window;
    return std::max(
        cycles, ratio * burst_cycles(reading ? reads * share : 0, writing ? writes * share : 0, p, policy));
  };
  const double first =
      ratio * (p.rcd + p.cl + p.read_more + p.beats() * p.columns_of_request() + p.interface_cycles);
  return std::llround(first + segment(alone, true, false) + segment(both, true, true) + rest +
                      segment(alone, false, true));
}

}  // namespace voxmelt::hwmodel::explore
