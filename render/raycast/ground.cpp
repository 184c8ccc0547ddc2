#include "render/raycast/ground.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/raycast/box.h"

namespace voxmelt::render {
namespace {

constexpr float kLowered = 0.5f;  // under wet columns, in cells
constexpr float kBevel = 0.6f;    // width of the slab's rounded edge, in cells

// From 1/4096 cell.
std::vector<float> cells_of(const std::vector<std::int32_t>& heights) {
  std::vector<float> cells;
  cells.reserve(heights.size());
  for (const std::int32_t height : heights) cells.push_back(static_cast<float>(height) / 4096);
  return cells;
}

}  // namespace

Ground::Ground(const scene::Terrain& terrain, const DensityField& field) {
  height_ = fits(terrain, field.grid()) ? terrain.height : cells_of(field.ground());
  if (std::all_of(height_.begin(), height_.end(), [](float h) { return h <= 0; })) return;
  size_x_ = field.grid().x;
  size_z_ = field.grid().z;
  textured_ = terrain.textured;
  height_ = blurred(height_, field.liquid_passes());
  drawn_ = height_;
  const Heights wetness = blurred(cells_of(field.wetness()), field.liquid_passes());
  for (std::size_t i = 0; i < drawn_.size(); ++i) drawn_[i] -= kLowered * wetness[i];
  surrounding_ = blurred(height_, 24);
  const auto [low, high] = std::minmax_element(height_.begin(), height_.end());
  lowest_ = *low;
  highest_ = *high;
  uneven_ = highest_ - lowest_ > 0.01f;
}

Ground::Heights Ground::blurred(const Heights& heights, int passes) const {
  Heights now = heights, next = heights;
  const auto sweep = [&](int count_along, std::size_t stride, int count_across, std::size_t stride_across) {
    for (int a = 0; a < count_across; ++a)
      for (int i = 0; i < count_along; ++i) {
        const auto at = [&](int k) {
          return now[static_cast<std::size_t>(a) * stride_across +
                     static_cast<std::size_t>(std::clamp(k, 0, count_along - 1)) * stride];
        };
        next[static_cast<std::size_t>(a) * stride_across + static_cast<std::size_t>(i) * stride] =
            0.25f * at(i - 1) + 0.5f * at(i) + 0.25f * at(i + 1);
      }
    now.swap(next);
  };
  const auto row = static_cast<std::size_t>(size_x_);
  for (int pass = 0; pass < passes; ++pass) {
    sweep(size_x_, 1, size_z_, row);
    sweep(size_z_, row, size_x_, 1);
  }
  return now;
}

float Ground::spline(const Heights& heights, float x, float z) const {
  const float fx = x - 0.5f, fz = z - 0.5f, bx = std::floor(fx), bz = std::floor(fz);
  const SplineWeights wx(fx - bx), wz(fz - bz);
  float sum = 0;
  for (int k = 0; k < 4; ++k) {
    const float* row =
        heights.data() + std::ptrdiff_t{size_x_} * std::clamp(static_cast<int>(bz) - 1 + k, 0, size_z_ - 1);
    float along = 0;
    for (int i = 0; i < 4; ++i)
      along += wx.value[i] * row[std::clamp(static_cast<int>(bx) - 1 + i, 0, size_x_ - 1)];
    sum += wz.value[k] * along;
  }
  return sum;
}

float Ground::linear(const Heights& heights, float x, float z) const {
  const float fx = x - 0.5f, fz = z - 0.5f, bx = std::floor(fx), bz = std::floor(fz);
  const auto at = [&](int dx, int dz) {
    const int cx = std::clamp(static_cast<int>(bx) + dx, 0, size_x_ - 1);
    const int cz = std::clamp(static_cast<int>(bz) + dz, 0, size_z_ - 1);
    return heights.data()[std::ptrdiff_t{size_x_} * cz + cx];
  };
  return mix(mix(at(0, 0), at(1, 0), fx - bx), mix(at(0, 1), at(1, 1), fx - bx), fz - bz);
}

Vec Ground::normal(float x, float z) const {
  constexpr float kReach = 0.5f;
  Vec n{0, 1, 0};
  if (uneven_)
    n = {spline(height_, x - kReach, z) - spline(height_, x + kReach, z), 2 * kReach,
         spline(height_, x, z - kReach) - spline(height_, x, z + kReach)};
  // The slab's edges are rounded a little, so that they catch the light.
  const auto tilt = [](float near, float far) {
    return std::max(0.0f, 1 - far / kBevel) - std::max(0.0f, 1 - near / kBevel);
  };
  n += Vec{tilt(x, static_cast<float>(size_x_) - x), 0, tilt(z, static_cast<float>(size_z_) - z)};
  return normalized(n);
}

std::optional<GroundHit> Ground::find(const Ray& ray) const {
  if (empty()) return std::nullopt;
  const Span span = clip(ray, {}, {static_cast<float>(size_x_), highest_, static_cast<float>(size_z_)});
  if (span.empty()) return std::nullopt;
  const auto above = [&](float t) {
    const Vec p = ray.at(t);
    return p.y - spline(drawn_, p.x, p.z);
  };

  const bool from_side = span.entry_normal.y == 0;
  if (from_side && above(span.from) < 0)
    return GroundHit{{span.from, ray.at(span.from), span.entry_normal}, true};

  // Steps shrink with the height above the ground. Then false position finds the crossing.
  float before = span.from;
  for (float t = span.from; before < span.to;) {
    const float height = above(t);
    if (height <= 0) {
      float high = above(before), low = height;
      for (int i = 0; i < 8 && high > low; ++i) {
        const float middle = before + (t - before) * (high / (high - low));
        const float value = above(middle);
        if (value > 0) {
          before = middle, high = value, low *= 0.5f;
        } else {
          t = middle, low = value, high *= 0.5f;
        }
        if (std::abs(value) < 0.002f) break;
      }
      const Vec p = ray.at(t);
      return GroundHit{{t, p, normal(p.x, p.z)}, false};
    }
    before = t;
    t = std::min(t + std::max(0.3f, height * 0.6f), span.to);
  }
  return std::nullopt;
}

float Ground::light_reaching(Vec point, Vec to_light) const {
  if (!uneven_ || to_light.y <= 0) return 1;
  constexpr float kSharpness = 9;
  float light = 1;
  for (float t = 1.5f; light > 0 && t < 200; t += std::max(0.8f, t * 0.12f)) {
    const Vec p = point + to_light * t;
    if (p.y > highest_ || p.x < 0 || p.z < 0 || p.x > static_cast<float>(size_x_) ||
        p.z > static_cast<float>(size_z_))
      break;
    light = std::min(light, 0.5f + kSharpness * (p.y - linear(height_, p.x, p.z)) / (t + 2));
  }
  return smooth_step(0, 1, light);
}

float Ground::openness(float x, float z) const {
  if (!uneven_) return 1;
  const float hollow = spline(surrounding_, x, z) - spline(height_, x, z);
  return std::clamp(1 - 0.16f * hollow, 0.45f, 1.12f);
}

}  // namespace voxmelt::render
