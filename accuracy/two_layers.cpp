#include "accuracy/two_layers.h"

#include <cmath>
#include <numbers>

namespace voxmelt::accuracy {
namespace {

constexpr int kWaves = 200;

}  // namespace

// A wave that dies as exp(-rate^2 t) is a sine in the first layer and a cosine, from behind, in the second.
double TwoLayers::wave_number(int layer, double rate) const {
  return rate * std::sqrt(capacity[layer] / conductivity[layer]);
}

// Returns 0 if heat flows out of the first layer as it flows into the second.
double TwoLayers::misfit(double rate) const {
  const double p = wave_number(0, rate), q = wave_number(1, rate);
  return conductivity[0] * p * std::cos(p * depth[0]) * std::cos(q * depth[1]) -
         conductivity[1] * q * std::sin(p * depth[0]) * std::sin(q * depth[1]);
}

// Returns the part of a wave in the first state, at a place and a time.
double TwoLayers::wave(double rate, double x, double time) const {
  const double p = wave_number(0, rate), q = wave_number(1, rate);
  const double first = std::cos(q * depth[1]), second = std::sin(p * depth[0]);  // heights of the two parts
  const double heat = capacity[0] * first * (1 - std::cos(p * depth[0])) / p +
                      capacity[1] * second * std::sin(q * depth[1]) / q;
  const double norm = capacity[0] * first * first * (depth[0] / 2 - std::sin(2 * p * depth[0]) / (4 * p)) +
                      capacity[1] * second * second * (depth[1] / 2 + std::sin(2 * q * depth[1]) / (4 * q));
  const double shape =
      x < depth[0] ? first * std::sin(p * x) : second * std::cos(q * (depth[0] + depth[1] - x));
  return heat / norm * shape * std::exp(-rate * rate * time);
}

double TwoLayers::temperature(double x, double time) const {
  // Rates are pi / delay apart on the mean, and a fortieth of that finds each change of sign.
  const double delay = wave_number(0, 1) * depth[0] + wave_number(1, 1) * depth[1];
  const double stride = std::numbers::pi / delay / 40;
  double sum = 0;
  int waves = 0;
  for (double low = stride / 2; waves < kWaves; low += stride) {
    if (misfit(low) * misfit(low + stride) > 0) continue;
    double from = low, to = low + stride;
    for (int i = 0; i < 60; ++i) {
      const double middle = (from + to) / 2;
      (misfit(from) * misfit(middle) > 0 ? from : to) = middle;
    }
    sum += wave((from + to) / 2, x, time);
    ++waves;
  }
  return 1 - sum;
}

double TwoLayers::time_of(double x, double wanted) const {
  double from = 1, to = 1e9;
  while (to - from > 1e-6 * to) {
    const double middle = std::sqrt(from * to);
    (temperature(x, middle) < wanted ? from : to) = middle;
  }
  return std::sqrt(from * to);
}

}  // namespace voxmelt::accuracy
