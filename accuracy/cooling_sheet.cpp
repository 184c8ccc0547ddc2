#include "accuracy/cooling_sheet.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxmelt::accuracy {

std::vector<double> CoolingSheet::at_rest(std::vector<double> depth, double temperature,
                                          int parts_per_cell) const {
  const std::size_t n = depth.size();
  std::vector<double> heat(n), flow(n - 1), warmth(n - 1);
  for (std::size_t i = 0; i < n; ++i) heat[i] = depth[i] * (temperature + latent);
  constexpr double kDry = 1e-6;
  const auto content = [&](std::size_t i) { return depth[i] > kDry ? heat[i] / depth[i] : air; };
  const auto temperature_at = [&](std::size_t i) {
    const double h = content(i);
    return h <= freezing ? h : std::max(freezing, h - latent);
  };

  for (bool runs = true; runs;) {
    const double deepest = *std::max_element(depth.begin(), depth.end());
    // An explicit step is stable up to half of dx^2 over the diffusivity of depth, kappa h^3 / 3, and of
    // heat.
    const double diffuses = kappa / 3 * std::pow(deepest, 3) * parts_per_cell * parts_per_cell;
    const double conducts = conductance * parts_per_cell * parts_per_cell;
    const double step = 0.25 / std::max({0.25, diffuses, conducts});
    runs = false;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double a = depth[i], b = depth[i + 1];
      const std::size_t giver = a > b ? i : i + 1;
      const bool cold = content(giver) < freezing;
      runs = runs || (depth[giver] > kDry && !cold);
      const double cubes = (a + b) * (a * a + b * b) / 4;  // the mean of h^3 over a linear profile
      flow[i] = cold ? 0 : step * kappa / 3 * cubes * (a - b) * parts_per_cell * parts_per_cell;
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const double carried = flow[i] * content(flow[i] > 0 ? i : i + 1);
      warmth[i] = carried + step * conducts * std::min(depth[i], depth[i + 1]) *
                                (temperature_at(i) - temperature_at(i + 1));
    }
    for (std::size_t i = 0; i + 1 < n; ++i) {
      heat[i] -= warmth[i];
      heat[i + 1] += warmth[i];
      depth[i] -= flow[i];
      depth[i + 1] += flow[i];
    }
    // The film of air and a third of the depth lie one behind the other: a layer that cools from above,
    // slowly, is warmer by that much on the mean than at its surface.
    for (std::size_t i = 0; i < n; ++i) {
      if (depth[i] <= kDry) continue;
      const double rate = 1 / (1 / exchange + depth[i] / (3 * conductance));
      const double part = 1 - std::exp(-rate * step / depth[i]);
      heat[i] += part * depth[i] * (air - temperature_at(i));
    }
  }
  return depth;
}

}  // namespace voxmelt::accuracy
