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
    const Blend wide = field.matter_pyramid().sample(point.x, point.y, point.z, static_cast<float>(level));
    sum.matter += weight * wide.matter;
    sum.liquid += weight * wide.liquid;
    sum.heat += weight * wide.heat;
  }
  return sum;
}

// 0 matter .. 1 obstacle, from the unfiltered cells, so that neither bleeds into the other. It is taken a
// little outside the surface, where a film outweighs what it covers.
float obstacle_share(const DensityField& field, const Sampler& sampler, Vec point, Vec normal) {
  if (!field.has_obstacles()) return 0;
  const CellFields& cells = field.cells();
  const Vec places[] = {point + normal * 0.5f, point};
  float obstacle = 0, matter = 0, weight = 1;
  for (const Vec place : places) {
    obstacle += weight * sampler.cubic(cells.obstacle, place);
    matter += weight * (sampler.cubic(cells.solid, place) + sampler.cubic(cells.liquid, place));
    weight = 0.02f;  // decides only where there is nothing outside
  }
  if (obstacle <= 0) return 0;
  return 1 - smooth_step(0.2f, 0.42f, matter / (matter + obstacle));
}

void blend_obstacle(Material& material, float share, const scene::Look& look) {
  if (share <= 0) return;
  constexpr Vec kWhite{1, 1, 1};
  material.obstacle = share;
  material.color = mix(material.color, mix(vec(look.ground), kWhite, 0.12f), share);
  material.emission = material.emission * (1 - share);
  material.specular = mix(material.specular, 0.03f, share);
  material.shininess = mix(material.shininess, 12.0f, share);
  material.metallic *= 1 - share;
}

}  // namespace

Material material_at(const DensityField& field, const Sampler& sampler, Vec point, Vec normal,
                     const scene::Look& look) {
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
  blend_obstacle(material, obstacle_share(field, sampler, point, normal), look);
  return material;
}

}  // namespace voxmelt::render
