// A run of liquid under the viscous law (docs/automaton.md, section 10): its record (the sums over its
// cells), the amounts it settles to, and what it shows to its neighbours.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "hwmodel/stream/stage.h"

namespace voxmelt::hwmodel {

inline constexpr std::int64_t kOverMax = kAmountMax - kOne;  // a cell under pressure holds this beyond ONE

// Widths that depend on the height of the grid.
struct RunWidths {
  int count;  // of cells of a run, less one
  int sum;    // of their amounts
  int head;   // signed

  explicit RunWidths(const Design& design) {
    const std::int64_t height = design.shape.grid.y, stiffness = design.parameters.flow.viscous.stiffness;
    count = bits_for(height - 1);
    sum = bits_for(kAmountMax * height);
    const std::int64_t highest_bed = 256 * (height - 1) + ((kAmountMax - kFlatBed) >> 4);
    head =
        1 + bits_for(highest_bed + (kAmountMax * height >> 4) + (stiffness - 1) * (kOverMax * height >> 4));
  }
};

// `last`: the number of cells less one.
inline std::int64_t over_of(std::int64_t sum, std::int64_t last) {
  return std::max<std::int64_t>(0, sum - (last + 1) * kOne);
}

// Settled amount of cell k, from scratch; the hardware steps from cell to cell (SettleScan).
inline std::int64_t settled_amount(std::int64_t sum, std::int64_t last, std::int64_t k) {
  const std::int64_t spare = over_of(sum, last) - kOverMax * (last - k);
  return std::clamp<std::int64_t>(sum - k * kOne, 0, kOne) + std::clamp<std::int64_t>(spare, 0, kOverMax);
}

// What all cells of a run show: computed once, at its first cell.
struct RunShow {
  SInt<30> head;
  UInt<14> mobility, exposed;
  UInt<25> dead;
};

// `entry`: of the mobility table, by the run's mean heat.
inline RunShow shown(std::int64_t sum, std::int64_t last, std::int64_t bed, std::int64_t entry,
                     const rule::Flow& flow, const RunWidths& widths) {
  const rule::ViscousLaw& law = flow.viscous;
  const std::int64_t over = over_of(wire(sum, widths.sum), wire(last, widths.count)), cells = (sum >> 12) + 1;
  const UInt<24> depth = std::max<std::int64_t>(1, sum >> 4);
  const UInt<15> capped = std::min<std::int64_t>(depth, 16384);
  const UInt<29> square = std::int64_t{capped} * capped;
  UInt<33> raw = (law.mobility * std::int64_t{square} + (1 << 19)) >> 20;
  if (flow.thermal_viscosity)
    raw = (std::int64_t{raw} * flow.mobility_table[static_cast<std::size_t>(entry)]) >> 15;

  RunShow show;
  show.head = signed_wire(bed + (sum >> 4) + (law.stiffness - 1) * (over >> 4), widths.head);
  show.exposed = std::min<std::int64_t>(raw, 8192);
  // floor(floor(8192 / cells) / stiffness) is one division by the product, and that three shifts and adds.
  show.mobility = std::min<std::int64_t>(raw, 8192 / (over > 0 ? cells * law.stiffness : cells));
  show.dead = std::max<std::int64_t>(1, (law.yield + (std::int64_t{depth} >> 1)) / depth);
  return show;
}

}  // namespace voxmelt::hwmodel
