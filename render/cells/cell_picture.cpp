#include "render/cells/cell_picture.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace voxmelt::render {
namespace {

// Parts of 256 of a colour.
constexpr int kWhole = 256, kTop = 256, kAlongX = 200, kAlongZ = 224, kBottom = 150;

int brightness(const SeenCell& seen) {
  if (seen.cut || seen.axis < 0) return kWhole;
  if (seen.axis == 1) return seen.outwards > 0 ? kTop : kBottom;
  return seen.axis == 0 ? kAlongX : kAlongZ;
}

Rgb pixel(const CellCaster& caster, int x, int y, int samples, const ColourOf& colour_of) {
  std::array<int, 3> sum{};
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const auto place = [&](int at, int sample) {  // of the middle of this part of the pixel
        return picture::kPixel * at + picture::kPixel * (2 * sample + 1) / (2 * samples);
      };
      const std::optional<SeenCell> seen = caster.see(place(x, i), place(y, j));
      const Rgb colour = seen ? colour_of(seen->cell) : kBehindCells;
      const int bright = seen ? brightness(*seen) : kWhole;
      for (std::size_t part = 0; part < sum.size(); ++part) sum[part] += colour[part] * bright / kWhole;
    }
  Rgb mean{};
  for (std::size_t part = 0; part < mean.size(); ++part)
    mean[part] = static_cast<std::uint8_t>(sum[part] / (samples * samples));
  return mean;
}

}  // namespace

Image draw_cells(const CellCaster& caster, int width, int height, int samples, const ColourOf& colour_of,
                 cpu::Workers& workers) {
  Image image(width, height);
  workers.run(height, [&](int y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = pixel(caster, x, y, samples, colour_of);
  });
  return image;
}

}  // namespace voxmelt::render
