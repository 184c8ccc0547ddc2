#include "render/raycast/rock.h"

#include "render/raycast/noise.h"

namespace voxmelt::render {
namespace {

float relief(Vec point) { return layered_noise(point * 0.35f, 4); }

// Tilts the normal against the slope of the relief.
Vec roughened(Vec normal, Vec point, float strength) {
  constexpr float kReach = 0.15f;
  const float here = relief(point);
  const Vec slope{relief(point + Vec{kReach, 0, 0}) - here, relief(point + Vec{0, kReach, 0}) - here,
                  relief(point + Vec{0, 0, kReach}) - here};
  const Vec along = slope - normal * dot(slope, normal);
  return normalized(normal - along * (strength / kReach));
}

}  // namespace

RockSample rock(const Ground& ground, const GroundHit& where, const scene::Look& look) {
  const Vec base = vec(look.ground);
  const Hit& hit = where.hit;
  if (where.side) {
    // Layers in the cut: soft bands, bent a little.
    const float band =
        ground.textured()
            ? layered_noise({0.03f * hit.point.x, 0.55f * hit.point.y + 0.4f * noise(hit.point * 0.08f),
                             0.03f * hit.point.z},
                            3)
            : 0.0f;
    return {base * (0.62f + 0.16f * band), hit.normal};
  }
  if (!ground.textured()) return {base, hit.normal};

  const float rise = ground.highest() - ground.lowest();
  const float elevation = rise > 0 ? (hit.point.y - ground.lowest()) / rise : 0.0f;
  const float patches = layered_noise(hit.point * 0.06f, 3);
  const float grain = layered_noise(hit.point * 0.5f, 3);
  const float steep = smooth_step(0.12f, 0.5f, 1 - hit.normal.y + 0.06f * patches);

  Vec color = mix(base * Vec{0.92f, 0.98f, 0.86f}, base * Vec{1.12f, 1.02f, 0.94f},
                  smooth_step(0.1f, 0.9f, elevation + 0.2f * patches));
  color = mix(color, base * Vec{0.62f, 0.6f, 0.6f}, 0.75f * steep);
  color = color * (1 + 0.14f * patches + 0.12f * grain);
  return {color, roughened(hit.normal, hit.point, 0.22f)};
}

}  // namespace voxmelt::render
