// Pictures have their rows from the top. Image holds colours in 8-bit sRGB, and Image16 holds numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::render {

using Rgb = std::array<std::uint8_t, 3>;

struct Image {
  Image() = default;
  Image(int w, int h, Rgb fill = {0, 0, 0}) : width(w), height(h) {
    const std::size_t row = w;
    pixels.assign(row * h, fill);
  }

  Rgb& at(int x, int y) { return pixels[index(x, y)]; }
  const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }

  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t index(std::size_t x, std::size_t y) const { return y * width + x; }
};
static_assert(sizeof(Rgb) == 3, "rows are handed to writers as bytes");

// Holds one number a pixel (a depth), or three (a vector).
struct Image16 {
  Image16() = default;
  Image16(int w, int h, int c) : width(w), height(h), channels(c) {
    const std::size_t row = w;
    numbers.assign(row * h * c, 0);
  }

  int width = 0, height = 0, channels = 1;
  std::vector<std::uint16_t> numbers;

  friend bool operator==(const Image16&, const Image16&) = default;
};

}  // namespace voxmelt::render
