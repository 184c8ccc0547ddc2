// Reads the filtered field between its cells. Positions in cells: cell (i, j, k) has its centre at i + 0.5.
#pragma once

#include <cstdint>

#include "render/density/density_field.h"
#include "render/image/vector.h"

namespace voxmelt::render {

// Uniform cubic B-spline weights of four neighbours and their derivatives, 0 <= t < 1 between the middle two.
struct SplineWeights {
  float value[4], slope[4];
  explicit SplineWeights(float t) {
    const float s = 1 - t;
    value[0] = s * s * s / 6;
    value[1] = (4 - 6 * t * t + 3 * t * t * t) / 6;
    value[2] = (4 - 6 * s * s + 3 * s * s * s) / 6;
    value[3] = t * t * t / 6;
    slope[0] = -s * s / 2;
    slope[1] = (3 * t * t - 4 * t) / 2;
    slope[2] = (4 * s - 3 * s * s) / 2;
    slope[3] = t * t / 2;
  }
};

struct FieldSample {
  float value = 0;
  Vec gradient;
};

class Sampler {
 public:
  explicit Sampler(const DensityField& field) : grid_(field.grid()), intensity_(field.intensity()) {}

  // Trilinear: exact at cell centres, quick; tells how far the surface may be.
  float linear(const Values<std::uint16_t>& cells, Vec point) const;
  float linear(Vec point) const { return linear(intensity_, point); }

  // Cubic B-spline: the surface itself. Its second derivatives are continuous, so neither the shape nor the
  // highlights show the cells. The result is never outside the range of the 4x4x4 cells around the point.
  float cubic(const Values<std::uint16_t>& cells, Vec point) const;
  float cubic(Vec point) const { return cubic(intensity_, point); }
  FieldSample cubic_with_gradient(Vec point) const;

 private:
  const state::Grid grid_;
  const Values<std::uint16_t>& intensity_;
};

}  // namespace voxmelt::render
