#include "render/raycast/environment.h"

namespace voxmelt::render {

Vec Environment::seen(Vec direction) const {
  constexpr Vec kHorizon{0.92f, 0.94f, 0.97f}, kZenith{0.22f, 0.26f, 0.33f};
  const Vec sky = mix(kHorizon, kZenith, smooth_step(0.0f - 0.2f * blur, 0.75f + 0.3f * blur, direction.y));
  const Vec below = mix(ground * 0.75f, ground * 0.25f, smooth_step(0.0f, 0.7f, -direction.y));
  Vec color = mix(below, sky, smooth_step(-0.06f - 0.3f * blur, 0.06f + 0.3f * blur, direction.y));

  const Vec strip = normalized(Vec{-to_light.x, 0.35f, -to_light.z});
  color += Vec{2.4f, 2.35f, 2.25f} *
           smooth_step(0.86f - 0.3f * blur, 0.93f + 0.07f * blur, dot(direction, to_light));
  color += Vec{0.7f, 0.75f, 0.85f} * smooth_step(0.8f - 0.3f * blur, 0.97f, dot(direction, strip));
  return color;
}

}  // namespace voxmelt::render
