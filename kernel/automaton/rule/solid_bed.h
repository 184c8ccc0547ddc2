// The bed offset of a solid cell follows from its amount and its heat (docs/automaton.md, section 10). A film
// on a body that melts so runs on a plane, where whole cells would be stairs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/materials.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

inline constexpr std::int32_t kThickest = kOne + kBedHalf - 1;  // amount up to which a solid raises its bed

class SolidBed {
 public:
  constexpr SolidBed() = default;
  constexpr explicit SolidBed(const Parameters& parameters)
      : SolidBed(parameters.heat.enabled,
                 std::int32_t{parameters.material.melting_point} + parameters.material.latent_heat,
                 parameters.material.latent_heat) {}
  // `liquid_from` is the heat from which on the material is liquid.
  constexpr SolidBed(bool hot, std::int32_t liquid_from, std::int32_t latent_heat)
      : hot_(hot), liquid_from_(liquid_from), range_(std::max(latent_heat, kOne)) {
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

  bool hot_ = false;
  std::int32_t liquid_from_ = 0, range_ = kOne;
  int shift_ = 0;
  std::int32_t scale_ = 0;
};

// Holds the beds of all materials.
class SolidBeds {
 public:
  explicit SolidBeds(const Parameters& parameters) : beds_{SolidBed(parameters)} {
    const Materials materials(parameters);
    for (std::size_t m = 0; m < parameters.materials.size(); ++m)
      beds_[m] = SolidBed(parameters.heat.enabled, materials.liquid_from(static_cast<int>(m)),
                          parameters.materials[m].latent_heat);
  }
  const SolidBed& of(int material) const { return beds_[static_cast<std::size_t>(material)]; }

 private:
  std::array<SolidBed, kMostMaterials> beds_;
};

}  // namespace voxmelt::rule
