// The bed offset of a solid cell follows from its amount and its heat (docs/automaton.md, section 10). A film
// on a body that melts so runs on a plane, where whole cells would be stairs.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kThickest = kOne + kBedHalf - 1;  // amount up to which a solid raises its bed

class SolidBed {
 public:
  constexpr explicit SolidBed(const Parameters& parameters)
      : hot_(parameters.heat.enabled),
        liquid_from_(parameters.material.melting_point + parameters.material.latent_heat),
        range_(std::max<std::int32_t>(parameters.material.latent_heat, kOne)) {
    while (range_ << (shift_ + 1) < 65536) ++shift_;
    const std::int32_t whole = range_ << shift_;
    scale_ = ((1 << 28) + whole - 1) / whole;
  }

  // Returns -kBedHalf .. kOne - 1, as the amount of an inert cell would say it. `h` is the heat content.
  VOXMELT_RULE std::int32_t offset(std::int32_t amount, std::int32_t h) const {
    return (std::min(amount, kThickest) * part(h) >> 12) - kBedHalf;
  }

 private:
  // Returns the part that has not melted. kOne is all of it.
  VOXMELT_RULE std::int32_t part(std::int32_t h) const {
    if (!hot_) return kOne;
    const std::int64_t lack = std::clamp(liquid_from_ - h, 0, range_);
    return static_cast<std::int32_t>((lack << shift_) * scale_ >> 16);
  }

  bool hot_;
  std::int32_t liquid_from_, range_;
  int shift_ = 0;
  std::int32_t scale_ = 0;
};

}  // namespace voxmelt::rule
