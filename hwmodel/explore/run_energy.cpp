#include "hwmodel/explore/run_energy.h"

#include <cmath>
#include <cstdint>
#include <map>

#include "hwmodel/memory/ratio.h"

namespace voxmelt::hwmodel::explore {

RunEnergy& RunEnergy::operator+=(const RunEnergy& more) {
  operations += more.operations;
  memory += more.memory;
  return *this;
}

RunEnergy operator*(double times, const RunEnergy& energy) {
  return {times * energy.operations, times * energy.memory};
}

double energy_of_tokens(const Train& train, const PartList& parts, bool coded) {
  double sum = coded ? static_cast<double>(train.passes) * parts.coder_energy : 0;
  std::map<StageKind, int> copies;  // of settle and spread there are several
  for (const StagePart& stage : parts.stages) {
    const int copy = copies[stage.kind]++;
    std::int64_t steps = 0;
    for (const Pass& pass : train.list)
      if (pass.uses(stage.kind, copy)) steps += pass.steps;
    sum += static_cast<double>(steps) * stage.token_energy;
  }
  return sum * static_cast<double>(parts.design.shape.tokens());
}

memory::Counts counts_of(const StreamWork& work, std::int64_t cycles, int clock_mhz,
                         const memory::Parameters& p) {
  constexpr std::int64_t kBurstBits = 8 * memory::kBurst;
  const auto bursts = [](std::int64_t bits) { return (bits + kBurstBits - 1) / kBurstBits; };
  memory::Counts counts;
  counts.reads = bursts(work.read_bits) + bursts(work.fed_bits);
  counts.writes = bursts(work.written_bits);
  counts.activates = std::llround(ratio((counts.reads + counts.writes) * memory::kBurst, p.row_bytes()));
  // Each channel has so many cycles of its own.
  counts.idle = std::llround(ratio(cycles * p.mhz, clock_mhz)) * p.channels;
  counts.active = counts.idle * p.ranks;
  (p.by_bank ? counts.bank_refreshes : counts.refreshes) =
      std::llround(ratio(counts.active, p.by_bank ? p.refi_bank : p.refi));
  return counts;
}

}  // namespace voxmelt::hwmodel::explore
