#include "render/raycast/occlusion.h"

#include <algorithm>
#include <cmath>

#include "render/raycast/box.h"

namespace voxmelt::render {
namespace {

constexpr float kExtinction = 1.0f;  // per cell of full matter

// Two directions that make a right-angled frame with n (Duff et al. 2017).
void frame(Vec n, Vec& s, Vec& t) {
  const float sign = std::copysign(1.0f, n.z);
  const float a = -1 / (sign + n.z), b = n.x * n.y * a;
  s = {1 + sign * n.x * n.x * a, sign * b, -sign * n.x};
  t = {b, sign + n.y * n.y * a, -n.y};
}

}  // namespace

Occlusion::Occlusion(const Pyramid& pyramid) : pyramid_(pyramid) {
  const PyramidLevel& level = pyramid.level(2);
  const float cell = 4, wide = 8;  // penumbras reach past the matter
  for (int z = 0; z < level.grid.z; ++z)
    for (int y = 0; y < level.grid.y; ++y)
      for (int x = 0; x < level.grid.x; ++x) {
        if (level.cells[level.index(x, y, z)].matter <= 0) continue;
        const Vec p = Vec{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)} * cell;
        const Vec l = p - Vec{wide, wide, wide}, h = p + Vec{cell + wide, cell + wide, cell + wide};
        low_ = any_ ? Vec{std::min(low_.x, l.x), std::min(low_.y, l.y), std::min(low_.z, l.z)} : l;
        high_ = any_ ? Vec{std::max(high_.x, h.x), std::max(high_.y, h.y), std::max(high_.z, h.z)} : h;
        any_ = true;
      }
}

float Occlusion::cone(Vec point, Vec direction, float start, float spread, float reach) const {
  if (!any_) return 1;
  const Ray ray{point, direction};
  const Span span = clip(ray, low_, high_);
  const float end = std::min(span.to, reach);
  float light = 1;
  for (float t = std::max(start, span.from); t < end && light > 0.01f;) {
    const float width = std::max(2.0f, spread * t);
    const float step = 0.5f * width;
    const Vec p = ray.at(t);
    const float matter = pyramid_.sample(p.x, p.y, p.z, std::log2(width)).matter;
    // Absorption goes by path length, so that a thin wall casts the same shadow through a narrow and a wide
    // cone. The least shares are ignored: they are the blurred fringe of the surface that is lit.
    light *= std::exp(-kExtinction * std::max(0.0f, matter - 0.04f) * step);
    t += step;
  }
  return light;
}

float Occlusion::light_reaching(Vec point, Vec normal, Vec to_light) const {
  return cone(point + normal * 1.2f, to_light, 1.8f, 0.12f, 400);
}

float Occlusion::reflection_reaching(Vec point, Vec normal, Vec direction) const {
  return cone(point + normal * 1.5f, direction, 2.0f, 0.5f, 60);
}

Ambient Occlusion::ambient(Vec point, Vec normal) const {
  if (!any_) return {};
  // Five cones over the half space; each doubles its width and reads the level that fits.
  Vec s, t;
  frame(normal, s, t);
  constexpr float kTilt = 0.82f, kUp = 0.57f;
  const struct {
    Vec direction;
    float weight;
  } cones[] = {{normal, 0.3f},
               {normal * kUp + s * kTilt, 0.175f},
               {normal * kUp - s * kTilt, 0.175f},
               {normal * kUp + t * kTilt, 0.175f},
               {normal * kUp - t * kTilt, 0.175f}};
  Ambient sum{0, 0};
  const Vec start = point + normal * 1.0f;
  for (const auto& [direction, weight] : cones) {
    float open = 1;
    for (int level = 1; level <= 4; ++level) {
      const Vec p = start + direction * (1.1f * static_cast<float>(1 << level));
      const Blend blend = pyramid_.sample(p.x, p.y, p.z, static_cast<float>(level));
      sum.glow += weight * open * blend.glow;
      open *= 1 - std::min(1.0f, blend.matter * 1.1f) * (level < 4 ? 0.8f : 0.5f);
    }
    sum.open += weight * open;
  }
  return sum;
}

}  // namespace voxmelt::render
