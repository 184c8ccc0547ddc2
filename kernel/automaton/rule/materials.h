// Each material has a curve of temperature over heat (docs/automaton.md, sections 6 and 7). A scene without a
// palette has one material, which is rule::Material.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/rule/heat.h"
#include "kernel/automaton/rule/parameters.h"

namespace voxmelt::rule {

class Materials {
 public:
  explicit Materials(const Parameters& parameters) {
    const Material& first = parameters.material;
    curves_[0] = {.points = {first.melting_point, first.latent_heat}};
    for (std::size_t m = 0; m < parameters.materials.size(); ++m) {
      curves_[m] = curve_of(parameters.materials[m], first);
      top_ = std::min(top_, temperature(kTemperatureMax, static_cast<int>(m)));
    }
  }

  std::int32_t temperature(std::int32_t h, int material) const {
    const Curve& curve = curves_[static_cast<std::size_t>(material)];
    const auto warm = static_cast<std::int32_t>((std::int64_t{h} * curve.warmth) >> 16);
    return std::min({top_, warm, temperature_of(h, curve.points)});
  }
  bool melts(std::int32_t h, int material) const { return h >= liquid_from(material); }
  // Returns the heat with which a cell that has melted goes on as the first material.
  std::int32_t melted(std::int32_t h, int material) const {
    const Curve& curve = curves_[static_cast<std::size_t>(material)];
    return material == 0 ? h : std::min(kTemperatureMax, h - liquid_from(material) + curve.as_first);
  }
  // Returns the heat from which on the material is liquid.
  std::int32_t liquid_from(int material) const {
    const Material& points = curves_[static_cast<std::size_t>(material)].points;
    return std::int32_t{points.melting_point} + points.latent_heat;
  }

 private:
  struct Curve {
    Material points;  // its latent heat is all that the cell takes up beyond its melting point, in heat
    std::int64_t warmth = kWarmthOne;
    std::int32_t as_first = 0;  // heat of the first material at this one's melting point, when liquid
  };

  static Curve curve_of(const SolidMaterial& material, const Material& first) {
    const std::int64_t more = material.heat_at(material.melting_point) - material.melting_point;
    Curve curve{.points = {.melting_point = material.melting_point}, .warmth = material.warmth};
    curve.points.latent_heat = static_cast<Temperature>(more + material.latent_heat);
    curve.as_first = material.melting_point;
    if (material.melting_point > first.melting_point) curve.as_first += first.latent_heat;
    return curve;
  }

  std::array<Curve, kMostMaterials> curves_;
  std::int32_t top_ = kTemperatureMax;
};

}  // namespace voxmelt::rule
