#include "render/raycast/glow.h"

#include <algorithm>
#include <cmath>

namespace voxmelt::render {

float glow_heat(float temperature, const scene::Look& look) {
  const auto cold = static_cast<float>(look.glow_cold), hot = static_cast<float>(look.glow_hot);
  return std::clamp((temperature - cold) / std::max(hot - cold, 1e-6f), 0.0f, 1.0f);
}

Vec glow_color(float heat) {
  const float h2 = heat * heat, h4 = h2 * h2;
  return {2.3f * std::pow(heat, 1.7f), 1.15f * h4 * std::sqrt(heat), 0.2f * h4 * h4};
}

Vec crust_color(float heat) {
  constexpr Vec kCold{0.034f, 0.029f, 0.028f};
  constexpr Vec kHot{0.04f, 0.014f, 0.008f};
  return mix(kCold, kHot, heat);
}

}  // namespace voxmelt::render
