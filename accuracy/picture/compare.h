// The functions here say how far two pictures are from each other.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "render/image/image.h"

namespace voxmelt::accuracy {

inline double square_error(const render::Rgb& a, const render::Rgb& b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += (a[c] - b[c]) * (a[c] - b[c]);
  return sum;
}

// Returns the ratio of peak to noise over all bytes, in dB. It is infinite for equal pictures.
inline double psnr(const render::Image& a, const render::Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += square_error(a.pixels[i], b.pixels[i]);
  if (sum == 0) return std::numeric_limits<double>::infinity();
  return 10 * std::log10(255 * 255 * 3 * static_cast<double>(a.pixels.size()) / sum);
}

// Draws grey where both are equal. A byte of difference counts eight times.
inline render::Image difference_picture(const render::Image& a, const render::Image& b) {
  render::Image image(a.width, a.height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      image.pixels[i][c] =
          static_cast<std::uint8_t>(std::clamp(128 + 8 * (a.pixels[i][c] - b.pixels[i][c]), 0, 255));
  return image;
}

}  // namespace voxmelt::accuracy
