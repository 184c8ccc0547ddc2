#include "render/raycast/sampler.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxmelt::render {
namespace {

// First of the neighbouring cells along one axis and the place between the two in the middle.
struct Place {
  int cell;
  float t;
  explicit Place(float position) {
    const float shifted = position - 0.5f;
    const float below = std::floor(shifted);
    cell = static_cast<int>(below);
    t = shifted - below;
  }
};

// Offsets of four neighbours along an axis, repeated at the border of the grid.
struct Taps {
  std::size_t offset[4];
  Taps(int cell, int side, std::size_t stride) {
    for (int i = 0; i < 4; ++i)
      offset[i] = static_cast<std::size_t>(std::clamp(cell - 1 + i, 0, side - 1)) * stride;
  }
};

}  // namespace

float Sampler::linear(const Values<std::uint16_t>& cells, Vec point) const {
  const Place px(point.x), py(point.y), pz(point.z);
  const auto clamped = [](int cell, int side) {
    return static_cast<std::size_t>(std::clamp(cell, 0, side - 1));
  };
  const std::size_t row = static_cast<std::size_t>(grid_.x), slice = row * static_cast<std::size_t>(grid_.y);
  const std::size_t x0 = clamped(px.cell, grid_.x), x1 = clamped(px.cell + 1, grid_.x);
  const std::size_t y0 = clamped(py.cell, grid_.y) * row, y1 = clamped(py.cell + 1, grid_.y) * row;
  const std::size_t z0 = clamped(pz.cell, grid_.z) * slice, z1 = clamped(pz.cell + 1, grid_.z) * slice;
  const auto along_x = [&](std::size_t base) {
    const float a = cells[base + x0], b = cells[base + x1];
    return a + (b - a) * px.t;
  };
  const float low = mix(along_x(y0 + z0), along_x(y1 + z0), py.t);
  const float high = mix(along_x(y0 + z1), along_x(y1 + z1), py.t);
  return mix(low, high, pz.t);
}

float Sampler::cubic(const Values<std::uint16_t>& of, Vec point) const {
  const Place px(point.x), py(point.y), pz(point.z);
  const std::size_t row = static_cast<std::size_t>(grid_.x), slice = row * static_cast<std::size_t>(grid_.y);
  const Taps tx(px.cell, grid_.x, 1), ty(py.cell, grid_.y, row), tz(pz.cell, grid_.z, slice);
  const SplineWeights wx(px.t), wy(py.t), wz(pz.t);
  float sum = 0;
  for (int k = 0; k < 4; ++k) {
    float plane = 0;
    for (int j = 0; j < 4; ++j) {
      const std::uint16_t* cells = of.data() + tz.offset[k] + ty.offset[j];
      plane += wy.value[j] * (wx.value[0] * cells[tx.offset[0]] + wx.value[1] * cells[tx.offset[1]] +
                              wx.value[2] * cells[tx.offset[2]] + wx.value[3] * cells[tx.offset[3]]);
    }
    sum += wz.value[k] * plane;
  }
  return sum;
}

FieldSample Sampler::cubic_with_gradient(Vec point) const {
  const Place px(point.x), py(point.y), pz(point.z);
  const std::size_t row = static_cast<std::size_t>(grid_.x), slice = row * static_cast<std::size_t>(grid_.y);
  const Taps tx(px.cell, grid_.x, 1), ty(py.cell, grid_.y, row), tz(pz.cell, grid_.z, slice);
  const SplineWeights wx(px.t), wy(py.t), wz(pz.t);
  FieldSample sample;
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j) {
      const std::uint16_t* cells = intensity_.data() + tz.offset[k] + ty.offset[j];
      float value = 0, slope = 0;
      for (int i = 0; i < 4; ++i) {
        const float cell = cells[tx.offset[i]];
        value += wx.value[i] * cell;
        slope += wx.slope[i] * cell;
      }
      sample.value += wz.value[k] * wy.value[j] * value;
      sample.gradient += Vec{wz.value[k] * wy.value[j] * slope, wz.value[k] * wy.slope[j] * value,
                             wz.slope[k] * wy.value[j] * value};
    }
  return sample;
}

}  // namespace voxmelt::render
