// Relaxed heads stand for the mean over a sub-step of heads that level out while it lasts (docs/automaton.md,
// section 11). They come by stages of super-time-stepping (RKL1; Meyer, Balsara, Aslam 2012): S stages go as
// far as S (S + 1) / 2 sub-steps. Each layer of cells relaxes by itself.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"

namespace voxmelt::rule {

inline constexpr int kMostStages = 16;
inline constexpr std::int32_t kMostRelaxedHead = 1 << 24;    // 32768 cells, so that all fits 32 bits
inline constexpr std::int32_t kRelaxedOne = 32768;           // one cell of relaxed head
inline constexpr std::int32_t kMostImpetus = (1 << 20) - 1;  // 32 cells

struct Relaxation {
  int stages = 1;  // 1..kMostStages; with one, heads are as they are

  VOXMELT_RULE bool relaxes() const { return stages > 1; }
  // Returns of how many sub-steps this one does the work.
  VOXMELT_RULE std::int32_t reach() const { return stages * (stages + 1) / 2; }
  // Returns the least number of bits in which `reach` finds room: reach <= 2^bits.
  VOXMELT_RULE int bits() const { return std::bit_width(static_cast<std::uint32_t>(reach() - 1)); }
  // Returns 2^bits / reach, in 1/32768. It is below 65536.
  VOXMELT_RULE std::int32_t scale() const { return (32768 << bits()) / reach(); }
  // Returns the time of stage j, in 1/65536 of the sub-step. That of the last one is 65536.
  VOXMELT_RULE std::int32_t time(int j) const { return 65536 * (j * j + j) / (stages * stages + stages); }
};

// Returns the least number of stages, at most `most`, that do the work of `substeps` sub-steps.
VOXMELT_RULE int stages_for(std::int64_t substeps, int most) {
  Relaxation relaxation{1};
  while (relaxation.reach() < substeps && relaxation.stages < most) ++relaxation.stages;
  return relaxation.stages;
}

// Returns what a pair levels of its difference in one stage, in 1/65536. A diagonal levels a quarter.
// `conductance` is in 1/2^24, `slope` in 1/16384, and both runs have `cells` cells or more.
VOXMELT_RULE std::int32_t leveling(std::int64_t conductance, std::int32_t slope, std::int32_t cells,
                                   bool diagonal, Relaxation relaxation) {
  const std::int64_t coarse = ((conductance >> (8 + relaxation.bits())) * slope) >> 16;
  return static_cast<std::int32_t>(
      std::min<std::int64_t>(65535, cells * ((coarse * relaxation.scale()) >> (diagonal ? 16 : 14))));
}

// Returns the head that a cell has at the end of stage j, integrated over time, in 1/32768 cell. `head` is in
// 1/512 cell, from two cells below its own on, and `change` is what neighbours have added.
VOXMELT_RULE std::int32_t integrated(std::int32_t head, std::int32_t change, int j, Relaxation relaxation) {
  const std::int64_t counted = std::min(kMostRelaxedHead, head);
  return static_cast<std::int32_t>((counted * relaxation.time(j)) >> 10) + change;
}

// Returns what the higher cell gives to the lower one after stage j. Their integrated heads differ by
// `difference`, at least 0. It counts up to a difference of one cell all the time.
VOXMELT_RULE std::int32_t leveled(std::int32_t difference, std::int32_t leveling, int j,
                                  Relaxation relaxation) {
  const std::int64_t counted = std::min(relaxation.time(j) >> 1, difference);
  return static_cast<std::int32_t>((leveling * counted) >> 16);
}

// Holds how the relaxed head of a cell moves away from its head.
struct Relaxing {
  std::int32_t impetus = 0, change = 0;

  // Adds stage j, 2 <= j, with the sums of what the cell took and gave.
  VOXMELT_RULE void add(std::int32_t taken, std::int32_t given, int j) {
    const std::int32_t gain = std::min(65535, taken) - std::min(65535, given);
    impetus = std::clamp(impetus + (2 * j - 1) * gain, -kMostImpetus, kMostImpetus);
    change += (impetus * ((4096 + j / 2) / j)) >> 12;
  }
};

}  // namespace voxmelt::rule
