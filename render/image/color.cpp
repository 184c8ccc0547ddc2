#include "render/image/color.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace voxmelt::render {
namespace {

float shoulder(float value) {
  constexpr float kStart = 0.7f, kRange = 0.3f;
  return value <= kStart ? value : kStart + kRange * (1 - std::exp(-(value - kStart) / kRange));
}

std::uint8_t byte(float linear) {
  const float v = std::clamp(linear, 0.0f, 1.0f);
  const float coded = v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(coded * 255));
}

}  // namespace

Vec tone_mapped(Vec linear) { return {shoulder(linear.x), shoulder(linear.y), shoulder(linear.z)}; }

Rgb srgb(Vec linear) { return {byte(linear.x), byte(linear.y), byte(linear.z)}; }

}  // namespace voxmelt::render
