#include "render/raycast/surface.h"

#include <algorithm>
#include <cmath>

#include "render/raycast/box.h"

namespace voxmelt::render {
namespace {

constexpr float kHalf = static_cast<float>(kFull) / 2;
constexpr float kStep = 0.5f;                             // between samples, in cells
constexpr float kFar = static_cast<float>(kFull) * 0.2f;  // trilinear below this: the cubic is below kHalf

}  // namespace

Surface::Surface(const DensityField& field, bool skip_empty)
    : field_(field), sampler_(field), skip_empty_(skip_empty) {
  find_occupied();
}

void Surface::find_occupied() {
  const state::Grid& bricks = field_.bricks();
  int low[3] = {bricks.x, bricks.y, bricks.z}, high[3] = {0, 0, 0};
  for (int z = 0; z < bricks.z; ++z)
    for (int y = 0; y < bricks.y; ++y)
      for (int x = 0; x < bricks.x; ++x) {
        if (static_cast<float>(field_.ranges()[bricks.index(x, y, z)].high) < kHalf) continue;
        const int at[3] = {x, y, z};
        for (int axis = 0; axis < 3; ++axis) {
          low[axis] = std::min(low[axis], at[axis]);
          high[axis] = std::max(high[axis], at[axis] + 1);
        }
      }
  const auto corner = [](const int(&brick)[3]) {
    return Vec{static_cast<float>(brick[0]), static_cast<float>(brick[1]), static_cast<float>(brick[2])} *
           static_cast<float>(kBrickSide);
  };
  low_ = corner(low);
  high_ = corner(high);
}

std::optional<Hit> Surface::find(const Ray& ray, float limit) const {
  const state::Grid& grid = field_.grid();
  const Span span =
      clip(ray, {}, {static_cast<float>(grid.x), static_cast<float>(grid.y), static_cast<float>(grid.z)});
  const float end = std::min(span.to, limit);
  if (span.from > end) return std::nullopt;

  // The samples lie at fixed distances from where the ray enters the grid. These are the first and the last
  // that matter.
  int first = 0;
  float last = end;
  if (skip_empty_) {
    const Span occupied = clip(ray, low_, high_);
    if (occupied.empty() || occupied.from > end) return std::nullopt;
    first = std::max(0, static_cast<int>((occupied.from - span.from) / kStep));
    last = std::min(end, occupied.to + kStep);
  }

  // Matter that touches the side of the grid is cut open there.
  const Vec entry = ray.at(span.from);
  if (first == 0 && sampler_.cubic(entry) >= kHalf) return Hit{span.from, entry, span.entry_normal};

  for (int k = first;;) {
    const float t = std::min(span.from + static_cast<float>(k) * kStep, end);
    const Vec point = ray.at(t);
    const int next = skip_empty_ ? skip_to(ray, point, span.from) : 0;
    if (next > k && t < end) {
      k = next;
      continue;
    }
    if (sampler_.linear(point) > kFar && sampler_.cubic(point) >= kHalf) {
      const float crossing = refine(ray, std::max(t - kStep, span.from), t);
      const Vec at = ray.at(crossing);
      return Hit{crossing, at, normalized(-sampler_.cubic_with_gradient(at).gradient)};
    }
    if (t >= last) return std::nullopt;
    ++k;
  }
}

float Surface::refine(const Ray& ray, float outside, float inside) const {
  float low = sampler_.cubic(ray.at(outside)) - kHalf, high = sampler_.cubic(ray.at(inside)) - kHalf;
  if (low >= 0) return outside;
  // False position, halving the kept end (Illinois) so that both ends close in.
  for (int i = 0; i < 4; ++i) {
    const float t = outside + (inside - outside) * (low / (low - high));
    const float value = sampler_.cubic(ray.at(t)) - kHalf;
    if (value < 0) {
      outside = t, low = value, high *= 0.5f;
    } else {
      inside = t, high = value, low *= 0.5f;
    }
  }
  return high > low ? outside + (inside - outside) * (low / (low - high)) : inside;
}

int Surface::skip_to(const Ray& ray, Vec point, float start) const {
  const state::Grid& bricks = field_.bricks();
  const auto brick = [](float position, int count) {
    return std::clamp(static_cast<int>(position) / kBrickSide, 0, count - 1);
  };
  const int bx = brick(point.x, bricks.x), by = brick(point.y, bricks.y), bz = brick(point.z, bricks.z);
  if (static_cast<float>(field_.ranges()[bricks.index(bx, by, bz)].high) >= kHalf) return 0;
  const Vec low{static_cast<float>(bx * kBrickSide), static_cast<float>(by * kBrickSide),
                static_cast<float>(bz * kBrickSide)};
  const float side = static_cast<float>(kBrickSide);
  const Span span = clip(ray, low, low + Vec{side, side, side});
  return span.empty() ? 0 : static_cast<int>(std::ceil((span.to - start) / kStep));
}

}  // namespace voxmelt::render
