// A run of liquid under the viscous law (docs/automaton.md, section 10) has a record, the sums over its
// cells. From it follow the amounts it settles to, and what it shows to its neighbours.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/materials.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// A bed's rise is its height above the lower face of the blocked cell, in 1/512 cell: (b + 2048) >> 3, with
// the bed offset b of the cell. So it is never negative, and the lowest three bits of b are not needed.
inline constexpr std::int64_t kFlatRise = (kFlatBed + 2048) >> 3;

inline UInt<14> rise_of_inert(std::int64_t amount) { return (amount + 2048) >> 3; }

// Computes the rise of solid cells. A solid is filled from below, and melted from above as far as its heat
// says. The host computes the constants of a scene. With heat this takes two products.
class SolidBed {
 public:
  static constexpr int kRiseBits = 10;
  static constexpr int kRowBits = 16 + 16 + 2 + 14;  // of a material: its melting heat, range, shift, scale

  struct Melt {
    UInt<16> range;  // how much heat it takes to melt
    UInt<2> shift;   // brings the range to 32768 and above
    UInt<14> scale;
  };

  explicit SolidBed(const Design& design) : hot_(design.hot()), curves_(design.parameters) {
    const rule::Parameters& parameters = design.parameters;
    if (!design.of_materials()) add(parameters.material.latent_heat);
    for (const rule::SolidMaterial& material : parameters.materials) add(material.latent_heat);
  }

  UInt<kRiseBits> rise(std::int64_t amount, std::int64_t heat, std::int64_t material = 0) const {
    UInt<13> part = kOne;  // the part that is not melted
    if (hot_) {
      const Melt& melt = looked_up(melts_, material);
      const std::int64_t left = curves_.liquid_from(material) - heat;
      const UInt<16> lack = std::clamp<std::int64_t>(left, 0, melt.range);
      const UInt<16> shifted = lack << melt.shift;
      part = UInt<29>(shifted * melt.scale) >> 16;
    }
    const UInt<13> filled = std::min<std::int64_t>(amount, kMostFilled);
    return UInt<26>(filled * part) >> 15;
  }
  const std::vector<Melt>& melts() const { return melts_; }  // of each material

 private:
  static constexpr std::int64_t kMostFilled = 4095 + 2048;  // no bed offset is beyond 4095

  void add(std::int64_t latent_heat) {
    const std::int64_t range = std::max(latent_heat, kOne);
    int shift = 0;
    while (range << (shift + 1) < 65536) ++shift;
    const std::int64_t whole = range << shift;
    melts_.push_back({range, shift, ((std::int64_t{1} << 28) + whole - 1) / whole});
  }

  bool hot_;
  Curves curves_;
  std::vector<Melt> melts_;  // index: material
};

// Returns the head of a bed below height y, in 1/512 cell.
inline std::int64_t bed_head(std::int64_t y, std::int64_t rise) { return 512 * (y - 1) + rise; }

inline constexpr std::int64_t kOverMax = kAmountMax - kOne;  // most that a cell holds beyond ONE

// Holds the widths that depend on the height of the grid.
struct RunWidths {
  int count;  // for the number of cells of a run, less one
  int sum;    // for the sum of their amounts
  int head;   // for the head, signed

  explicit RunWidths(const Design& design) {
    const std::int64_t height = design.shape.grid.y, stiffness = design.parameters.flow.viscous.stiffness;
    count = bits_for(height - 1);
    sum = bits_for(kAmountMax * height);
    const std::int64_t highest_bed = bed_head(height - 1, rise_of_inert(kAmountMax));
    head =
        1 + bits_for(highest_bed + (kAmountMax * height >> 3) + (stiffness - 1) * (kOverMax * height >> 3));
  }
};

// Returns the amount of a run beyond full cells. `last` is the number of cells less one.
inline std::int64_t over_of(std::int64_t sum, std::int64_t last) {
  return std::max<std::int64_t>(0, sum - (last + 1) * kOne);
}

// Returns true if a run is full, but for 1/64 of a cell. Under a ceiling it is shut then.
inline bool is_full(std::int64_t sum, std::int64_t last) {
  const SInt<29> excess = sum - (last + 1) * kOne;
  return -kOne / 64 <= excess && excess <= kOne / 64;
}

// Returns the settled amount of cell k, from scratch. The hardware steps from cell to cell (ShowScan).
inline std::int64_t settled_amount(std::int64_t sum, std::int64_t last, std::int64_t k) {
  const std::int64_t spare = over_of(sum, last) - kOverMax * (last - k);
  return std::clamp<std::int64_t>(sum - k * kOne, 0, kOne) + std::clamp<std::int64_t>(spare, 0, kOverMax);
}

// Returns the mobility parameter of one of so many sub-steps. The host divides.
inline std::int64_t pace_of(const rule::Flow& flow, int substeps) {
  return (static_cast<std::int64_t>(flow.viscous.mobility) + substeps / 2) / substeps;
}

// Returns which of n sub-steps number k is for the pairs of an axis.
inline int turn_of(int k, int n, int axis) { return (k + axis * n / 4) % n; }

// Holds what all cells of a run show. It is computed once, at the run's first cell.
struct RunShow {
  SInt<30> head;
  UInt<22> mobility;  // not limited yet, but cut above every limit
  UInt<14> limit;
  UInt<25> dead;
};

// Returns the mobility times 2^(x / 65536). The power of the fraction is a parabola of two products.
inline std::int64_t warmed(UInt<40> mobility, UInt<16> mean, const rule::Flow& flow) {
  const SInt<17> above = std::int64_t{mean} - flow.mobility_reference;
  const SInt<26> octaves = SInt<32>(above * std::int64_t{flow.mobility_rate}) >> 6;
  const SInt<22> x = std::clamp<std::int64_t>(octaves, -(1 << 21), (1 << 19) - 1);
  const UInt<16> fraction = x & 0xFFFF;
  const UInt<16> slope = 43057 + (22479 * fraction >> 16);
  const UInt<13> power = kOne + (std::int64_t{fraction} * slope >> 20);
  return UInt<53>(std::int64_t{mobility} * power) >> (12 - (std::int64_t{x} >> 16));
}

// `mean` is the run's mean heat, with thermal viscosity. `pace` is the mobility parameter of one sub-step.
inline RunShow shown(std::int64_t sum, std::int64_t last, std::int64_t bed, std::int64_t mean,
                     const rule::Flow& flow, std::int64_t pace, const RunWidths& widths) {
  const rule::ViscousLaw& law = flow.viscous;
  const std::int64_t over = over_of(wire(sum, widths.sum), wire(last, widths.count)), cells = (sum >> 12) + 1;
  const UInt<24> depth = std::max<std::int64_t>(1, sum >> 4);
  const UInt<19> capped = std::min<std::int64_t>(sum, 1 << 18);
  const UInt<29> square = (std::int64_t{capped} * capped) >> 8;
  // The product has 64 bits. It is computed in two parts of 18 x 29.
  const UInt<47> low = (wire(pace, 36) & 0x3FFFF) * square + (1 << 23);
  const UInt<47> high = (pace >> 18) * square + (low >> 18);
  std::int64_t raw = high >> 6;
  if (flow.thermal_viscosity) raw = warmed(raw, mean, flow);

  RunShow show;
  show.head = signed_wire(bed + (sum >> 3) + (law.stiffness - 1) * (over >> 3), widths.head);
  // The limit floor(floor(13107 / cells) / stiffness) is one division by a product of three shifts and adds.
  show.limit = std::max<std::int64_t>(1, 13107 / (over > 0 ? cells * law.stiffness : cells));
  show.mobility = std::min<std::int64_t>(raw, (1 << 22) - 1);
  show.dead = std::max<std::int64_t>(1, (2 * std::int64_t{law.yield} + (std::int64_t{depth} >> 1)) / depth);
  return show;
}

}  // namespace voxmelt::hwmodel
