// A sampling says how many samples which pixels get (docs/picture/definition.md, section 10), for pixels of
// any origin.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "kernel/engine/cpu/workers.h"
#include "render/image/image.h"
#include "render/rule/antialias.h"

namespace voxmelt::accuracy {

using Places = std::span<const picture::Sub>;

// The converged picture takes these 64 samples.
inline constexpr std::array<picture::Sub, 64> kLattice = [] {
  std::array<picture::Sub, 64> values{};
  for (std::int32_t i = 0; i < 64; ++i) values[i] = {8 * (i % 8) + 4, 8 * (i / 8) + 4};
  return values;
}();

// The first pass samples every pixel. Each later one samples those that differ by more than `most` from a
// neighbour of the picture so far.
struct Sampling {
  struct Pass {
    int most;
    Places places;
  };
  Places first;
  std::vector<Pass> passes;
};
inline Sampling fast_sampling() { return {picture::kMiddle, {}}; }
inline Sampling normal_sampling(int most = picture::kDifference) {
  return {picture::kMiddle, {{most, picture::kEight}}};
}
inline Sampling best_sampling(int most = picture::kFineDifference) {
  return {picture::kMiddle, {{most, picture::kThirtyTwo}}};
}
inline Sampling lattice_sampling() { return {kLattice, {}}; }

inline bool differs(const render::Image& image, int x, int y, int most) {
  const auto from = [&](int nx, int ny) {
    return nx >= 0 && ny >= 0 && nx < image.width && ny < image.height &&
           picture::differ(image.at(x, y), image.at(nx, ny), most);
  };
  return from(x - 1, y) || from(x + 1, y) || from(x, y - 1) || from(x, y + 1);
}

struct Sampled {
  render::Image image;
  double samples = 0;  // mean number per pixel
};

// Draws a picture. pixel(x, y, places) gives the bytes of a pixel.
template <class Pixel>
Sampled sampled(int width, int height, const Sampling& sampling, const Pixel& pixel, cpu::Workers& workers) {
  Sampled result{render::Image(width, height), 0};
  std::vector<std::size_t> counts(height);
  const auto pass = [&](Places places, const auto& wanted) {
    workers.run(height, [&](int y) {
      for (int x = 0; x < width; ++x) {
        if (!wanted(x, y)) continue;
        result.image.at(x, y) = pixel(x, y, places);
        counts[y] += places.size();
      }
    });
  };
  pass(sampling.first, [](int, int) { return true; });
  for (const Sampling::Pass& more : sampling.passes) {
    const render::Image before = result.image;
    pass(more.places, [&](int x, int y) { return differs(before, x, y, more.most); });
  }
  result.samples =
      static_cast<double>(std::accumulate(counts.begin(), counts.end(), std::size_t{0})) / (width * height);
  return result;
}

}  // namespace voxmelt::accuracy
