// Some pictures must be the same, and their first difference is described here.
#pragma once

#include <cstddef>
#include <string>

#include "render/image/image.h"

namespace voxmelt::test {

// Says where two pictures differ first, and how often. Returns nothing if they do not differ.
inline std::string difference(const render::Image& expected, const render::Image& found) {
  if (expected.width != found.width || expected.height != found.height) return "another size";
  std::size_t pixels = 0;
  std::string first;
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    if (expected.pixels[i] == found.pixels[i]) continue;
    ++pixels;
    for (std::size_t c = 0; c < 3 && first.empty(); ++c)
      if (expected.pixels[i][c] != found.pixels[i][c])
        first = "pixel " + std::to_string(i % static_cast<std::size_t>(expected.width)) + ", " +
                std::to_string(i / static_cast<std::size_t>(expected.width)) + ", channel " +
                std::to_string(c) + ": " + std::to_string(expected.pixels[i][c]) + " expected, " +
                std::to_string(found.pixels[i][c]) + " found";
  }
  return first.empty() ? first : first + "; " + std::to_string(pixels) + " pixels differ";
}

}  // namespace voxmelt::test
