#include "render/raycast/material.h"

#include <algorithm>

#include "render/raycast/glow.h"

namespace voxmelt::render {
namespace {

Blend blend_at(const DensityField& field, const Sampler& sampler, Vec point) {
  constexpr float kUnit = 1.0f / static_cast<float>(kFull);
  Blend sum;
  sum.liquid = sampler.linear(field.liquid(), point) * kUnit;
  sum.matter = sum.liquid + sampler.linear(field.solid(), point) * kUnit;
  sum.heat = sampler.linear(field.heat(), point) * kUnit;
  float weight = 0.05f;
  for (int level = 1; level <= 3; ++level, weight *= 0.02f) {
    const Blend wide = field.pyramid().sample(point.x, point.y, point.z, static_cast<float>(level));
    sum.matter += weight * wide.matter;
    sum.liquid += weight * wide.liquid;
    sum.heat += weight * wide.heat;
  }
  return sum;
}

}  // namespace

Material material_at(const DensityField& field, const Sampler& sampler, Vec point, const scene::Look& look) {
  const Blend blend = blend_at(field, sampler, point);
  Material material;
  material.liquid = blend.matter > 0 ? std::clamp(blend.liquid / blend.matter, 0.0f, 1.0f) : 0.0f;
  material.specular = static_cast<float>(look.specular) * mix(0.7f, 1.0f, material.liquid);
  material.shininess = static_cast<float>(look.shininess);
  material.metallic = static_cast<float>(look.metallic);
  material.color = mix(vec(look.solid), vec(look.liquid), material.liquid);
  if (look.glow) {
    const float temperature = blend.liquid > 0 ? blend.heat / blend.liquid : 0.0f;
    const float heat = glow_heat(temperature, look);
    material.color = mix(vec(look.solid), crust_color(heat), material.liquid);
    material.emission = glow_color(heat) * material.liquid;
    material.metallic = 0;
    material.specular *= mix(1.0f, 0.12f, material.liquid);  // molten rock is dull
  }
  return material;
}

}  // namespace voxmelt::render
