#include "render/raycast/light.h"

#include <algorithm>
#include <cmath>

#include "render/raycast/glow.h"

namespace voxmelt::render {
namespace {

constexpr Vec kLamp{1.06f, 1.0f, 0.92f};
constexpr Vec kSky{0.94f, 1.0f, 1.08f};
constexpr float kWrap = 0.15f;  // light bleeds a little past the terminator, as in wax
constexpr float kGlowStrength = 20.0f;

}  // namespace

Vec reflected(const Material& material, const Incoming& in, float ambient, Vec ground_color) {
  const float facing = dot(in.normal, in.to_light);
  const float lit = std::max(0.0f, (facing + kWrap) / (1 + kWrap)) * in.lamp;
  const float up = 0.5f + 0.5f * in.normal.y;
  const Vec from_sky = mix(ground_color * 0.9f, kSky, up) * (ambient * in.open);
  const Vec lamp = kLamp * (1.2f * (1 - ambient));

  // Diffuse; metals have next to none.
  Vec light = from_sky + lamp * lit + kGlowLight * (kGlowStrength * in.glow);
  light = light * material.color * (1 - 0.85f * material.metallic);

  // Highlight of the lamp.
  const Vec halfway = normalized(in.to_light + in.to_eye);
  const float peak = std::pow(std::max(0.0f, dot(in.normal, halfway)), material.shininess);
  const Vec tint = mix(Vec{1, 1, 1}, material.color, material.metallic);
  light += tint * lamp * (material.specular * peak * smooth_step(0, 0.25f, facing) * in.lamp);

  // Mirrored surroundings.
  const float eye = std::clamp(dot(in.normal, in.to_eye), 0.0f, 1.0f);
  const float graze = std::pow(1 - eye, 5.0f);
  const Vec head_on =
      mix(Vec{0.04f, 0.04f, 0.04f} * (2 * material.specular), material.color, material.metallic);
  const float gloss = mix(2 * material.specular * 0.6f, 1.0f, material.metallic);
  const Vec fresnel = head_on + (Vec{1, 1, 1} - head_on) * (graze * gloss * 0.7f);
  const Vec mirror = in.normal * (2 * dot(in.normal, in.to_eye)) - in.to_eye;
  const Environment environment{in.to_light, ground_color,
                                std::clamp(6 / (material.shininess + 6), 0.05f, 1.0f)};
  const float seen = in.mirrored * in.open;
  light += fresnel * environment.seen(normalized(mirror)) * mix(1.0f, seen, 0.85f);

  // Glowing liquid is a little darker where its surface turns away, which shows its shape.
  return light + material.emission * (0.62f + 0.38f * eye);
}

}  // namespace voxmelt::render
