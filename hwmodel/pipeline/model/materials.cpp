#include "hwmodel/pipeline/model/materials.h"

#include <cstddef>

namespace voxmelt::hwmodel {

Curves::Curves(const rule::Parameters& parameters) {
  const rule::Material& first = parameters.material;
  if (parameters.materials.empty()) {
    curves_.resize(1);
    curves_[0].melting_point = first.melting_point;
    curves_[0].beyond = first.latent_heat;
  }
  std::int64_t top = kHeatMax;
  for (const rule::SolidMaterial& material : parameters.materials) {
    const std::int64_t melting = material.melting_point, warmth = material.warmth;
    const std::int64_t solid_to = (65536 * melting + warmth - 1) / warmth;
    Curve curve;
    curve.warmth = warmth;
    curve.melting_point = melting;
    curve.beyond = solid_to + material.latent_heat - melting;
    curve.as_first = melting > first.melting_point ? melting + first.latent_heat : melting;
    curves_.push_back(curve);
    top = std::min<std::int64_t>(top, temperature(kHeatMax, static_cast<std::int64_t>(curves_.size()) - 1));
  }
  top_ = top;
}

PairWeights::PairWeights(const rule::Parameters& parameters, std::uint16_t only, Row row) {
  if (parameters.materials.empty()) words_.emplace_back(only);
  for (std::size_t one = 0; one < parameters.materials.size(); ++one)
    for (std::size_t other = 0; other <= one; ++other)
      words_.emplace_back((parameters.materials[one].*row)[other]);
}

}  // namespace voxmelt::hwmodel
