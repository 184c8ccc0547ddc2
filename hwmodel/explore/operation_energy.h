// The energy of the logic is counted by its operations: bits that are added, products, and bits that go into
// buffers and come out of them. M. Horowitz, "Computing's energy problem (and what we can do about it)",
// ISSCC 2014, has that of each in 45 nm at 0.9 V. So this is the energy of the operations in a chip of its
// own. The clock, registers, leakage and the ways of an FPGA are not in it.
#pragma once

#include <vector>

#include "hwmodel/explore/device.h"
#include "hwmodel/pipeline/check/verify.h"

namespace voxmelt::hwmodel::explore {

// All are picojoules.
struct OperationEnergy {
  double add = 0, multiply = 0, buffer = 0;
  double all() const { return add + multiply + buffer; }
  OperationEnergy& operator+=(const OperationEnergy& more);
};
OperationEnergy operator*(double times, const OperationEnergy& energy);

double energy_of_addition(double bits);
double energy_of_product(int wide, int narrow);
// A word goes into a memory of SRAM, or comes out of it.
double energy_of_access(double word_bits, double memory_bits);

// Returns what a stage takes for one token. Where the family counts a LUT, a bit is taken to be added.
OperationEnergy energy_of_token(StageKind kind, const Units& units, const std::vector<BufferCost>& buffers,
                                int lanes, const Family& family);
// Returns what a run took. Every busy cycle of a stage is a token.
OperationEnergy energy_of_run(const VerifyReport& report, int lanes, const Family& family);

}  // namespace voxmelt::hwmodel::explore
