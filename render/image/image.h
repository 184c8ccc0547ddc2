// An 8-bit sRGB picture: rows from the top, three bytes a pixel (red, green, blue).
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
    pixels.assign(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), fill);
  }

  Rgb& at(int x, int y) { return pixels[index(x, y)]; }
  const Rgb& at(int x, int y) const { return pixels[index(x, y)]; }

  int width = 0, height = 0;
  std::vector<Rgb> pixels;

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};
static_assert(sizeof(Rgb) == 3, "rows are handed to writers as bytes");

}  // namespace voxmelt::render
