#include "accuracy/radial.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace voxmelt::accuracy {

// The heat of a shell is in latent heats above the melting point, per volume: it melts from 0 to 1, and its
// temperature rises from there on. Times 4 pi cancels.
double MouldedBall::time_of(double part) const {
  constexpr int kShells = 160;
  const double width = radius / kShells, step = 0.2 * width * width / diffusivity;
  std::vector<double> heat(kShells, 0.0), volume(kShells), conducts(kShells);
  for (int i = 0; i < kShells; ++i) {
    const double inner = i * width, outer = inner + width;
    volume[i] = (std::pow(outer, 3) - std::pow(inner, 3)) / 3;
    conducts[i] = diffusivity * outer * outer / width;  // of the face beyond the shell
  }
  // From the middle of the last shell to the wall a resistance of 1/r - 1/(radius + gap).
  conducts.back() = diffusivity / (1 / (radius - width / 2) - 1 / (radius + gap));
  const auto temperature = [&](int i) { return i == kShells ? stefan : std::max(0.0, heat[i] - 1); };
  const double wanted = part * std::pow(radius, 3) / 3;
  std::vector<double> flow(kShells);
  double before = 0, time = 0;
  while (true) {
    for (int i = 0; i < kShells; ++i) flow[i] = step * conducts[i] * (temperature(i + 1) - temperature(i));
    double melted = 0;
    for (int i = 0; i < kShells; ++i) {
      heat[i] += (flow[i] - (i > 0 ? flow[i - 1] : 0)) / volume[i];
      melted += volume[i] * std::min(1.0, heat[i]);
    }
    if (melted >= wanted) return time + step * (wanted - before) / (melted - before);
    before = melted;
    time += step;
  }
}

// The surface moves inward by `rate` per step.
double BaredBall::time_of(double part) const { return radius * (1 - std::cbrt(1 - part)) / rate; }

}  // namespace voxmelt::accuracy
