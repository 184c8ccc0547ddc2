#include "kernel/scene/shape/coverage.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace voxmelt::scene {
namespace {

constexpr int kLargestBlock = 16;
constexpr double kSlack = 1e-6;  // rounding of distances, cells

class Sampler {
 public:
  Sampler(const Shape& shape, Coverage& coverage) : shape_(shape), coverage_(coverage) {}

  void block(int x, int y, int z, int size) {
    const Window& window = coverage_.window;
    if (x >= window.x + window.size.x || y >= window.y + window.size.y || z >= window.z + window.size.z)
      return;
    const double half = size * 0.5;
    const double distance = shape_.distance({x + half, y + half, z + half});
    const double reach = half * std::numbers::sqrt3 + kSlack;
    if (distance > reach) return;
    if (distance < -reach) return fill(x, y, z, size);
    if (size == 1) {
      coverage_.samples[window.index(x, y, z)] = cell(x, y, z);
      return;
    }
    const int child = size / 2;
    for (int i = 0; i < 8; ++i)
      block(x + (i & 1) * child, y + (i >> 1 & 1) * child, z + (i >> 2) * child, child);
  }

 private:
  void fill(int x, int y, int z, int size) {
    const Window& window = coverage_.window;
    const int x_end = std::min(x + size, window.x + window.size.x);
    const int y_end = std::min(y + size, window.y + window.size.y);
    const int z_end = std::min(z + size, window.z + window.size.z);
    for (int cz = z; cz < z_end; ++cz)
      for (int cy = y; cy < y_end; ++cy) {
        auto row = coverage_.samples.begin() + window.index(x, cy, cz);
        std::fill(row, row + (x_end - x), static_cast<std::uint8_t>(kSamplesPerCell));
      }
  }

  // Counts the covered samples of a cell. Its octants come first: one distance decides most of them, and
  // eight samples decide each of the rest.
  std::uint8_t cell(int x, int y, int z) const {
    const double reach = 0.25 * std::numbers::sqrt3 + kSlack;
    int covered = 0;
    for (int octant = 0; octant < 8; ++octant) {
      const Point centre{x + 0.25 + 0.5 * (octant & 1), y + 0.25 + 0.5 * (octant >> 1 & 1),
                         z + 0.25 + 0.5 * (octant >> 2)};
      const double distance = shape_.distance(centre);
      if (distance > reach) continue;
      if (distance < -reach) {
        covered += 8;
        continue;
      }
      for (int i = 0; i < 8; ++i) {
        const Point offset{i & 1 ? 0.125 : -0.125, i & 2 ? 0.125 : -0.125, i & 4 ? 0.125 : -0.125};
        covered += shape_.distance(centre + offset) <= 0 ? 1 : 0;
      }
    }
    return static_cast<std::uint8_t>(covered);
  }

  const Shape& shape_;
  Coverage& coverage_;
};

}  // namespace

Window window_of(const Box& box, state::Grid grid) {
  const auto clip = [](double low, double high, double cells, int& first, int& count) {
    if (!std::isfinite(low) || !std::isfinite(high)) return;  // a scale left no finite numbers
    first = static_cast<int>(std::clamp(std::floor(low), 0.0, cells));
    count = std::max(0, static_cast<int>(std::clamp(std::ceil(high), 0.0, cells)) - first);
  };
  Window window;
  clip(box.low.x, box.high.x, grid.x, window.x, window.size.x);
  clip(box.low.y, box.high.y, grid.y, window.y, window.size.y);
  clip(box.low.z, box.high.z, grid.z, window.z, window.size.z);
  return window;
}

Coverage cover(const Shape& shape, state::Grid grid) {
  Coverage coverage{window_of(shape.bounds(), grid), {}};
  const Window& window = coverage.window;
  coverage.samples.resize(window.size.cells());
  Sampler sampler(shape, coverage);
  for (int z = window.z; z < window.z + window.size.z; z += kLargestBlock)
    for (int y = window.y; y < window.y + window.size.y; y += kLargestBlock)
      for (int x = window.x; x < window.x + window.size.x; x += kLargestBlock)
        sampler.block(x, y, z, kLargestBlock);
  return coverage;
}

}  // namespace voxmelt::scene
