#include "hwmodel/explore/operation_energy.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace voxmelt::hwmodel::explore {
namespace {

// Horowitz: 0.1 pJ for a sum of 32 bits, 3.1 pJ for a product of 32 by 32, and 10 pJ for 64 bits of a memory
// of 8 KiB. His sum of 8 bits (0.03 pJ), product of 8 by 8 (0.2 pJ) and memories of 32 KiB (20 pJ) and 1 MiB
// (100 pJ) follow from these in proportion to bits, to the product of the widths, and to the root of the
// size.
constexpr double kAddedBit = 0.1 / 32;
constexpr double kMultipliedBit = 3.1 / (32 * 32);
constexpr double kAccessedBit = 10.0 / 64;
constexpr double kSize = 8.0 * 8192;  // bits

}  // namespace

OperationEnergy& OperationEnergy::operator+=(const OperationEnergy& more) {
  add += more.add;
  multiply += more.multiply;
  buffer += more.buffer;
  return *this;
}

OperationEnergy operator*(double times, const OperationEnergy& energy) {
  return {times * energy.add, times * energy.multiply, times * energy.buffer};
}

double energy_of_addition(double bits) { return kAddedBit * bits; }

double energy_of_product(int wide, int narrow) { return kMultipliedBit * wide * narrow; }

double energy_of_access(double word_bits, double memory_bits) {
  return kAccessedBit * word_bits * std::sqrt(memory_bits / kSize);
}

OperationEnergy energy_of_token(StageKind kind, const Units& units, const std::vector<BufferCost>& buffers,
                                int lanes, const Family& family) {
  OperationEnergy energy;
  if (const auto cost = family.stages.find(kind); cost != family.stages.end()) {
    const auto& multipliers = cost->second.multipliers;
    const std::int64_t blocks = units.random_blocks * ((lanes + 7) / 8);
    energy.add = energy_of_addition(static_cast<double>(
        lanes * (cost->second.lane.lut.value + units.dividers * family.divider.lut.value) +
        blocks * family.random_block.lut.value));
    for (int i = 0; i < units.multipliers && !multipliers.empty(); ++i) {
      const Widths& widths = multipliers[std::min<std::size_t>(i, multipliers.size() - 1)];
      energy.multiply += lanes * energy_of_product(widths.wide, widths.narrow);
    }
  }
  for (const BufferCost& buffer : buffers) {
    const auto word = static_cast<double>(buffer.lanes * buffer.bits);
    energy.buffer += 2 * energy_of_access(word, static_cast<double>(buffer.total()));
  }
  return energy;
}

OperationEnergy energy_of_run(const VerifyReport& report, int lanes, const Family& family) {
  OperationEnergy energy;
  for (const StageReport& stage : report.stages)
    energy += static_cast<double>(stage.cycles.busy) *
              energy_of_token(stage.kind, stage.units, stage.buffers, lanes, family);
  return energy;
}

}  // namespace voxmelt::hwmodel::explore
