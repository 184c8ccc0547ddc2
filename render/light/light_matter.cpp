#include "render/light/light_matter.h"

#include <algorithm>
#include <cstddef>

#include "render/rule/matter.h"

namespace voxmelt::render {
namespace {

// Calls visit(x, y, z) for the cells of a cell of light that lie in the grid.
template <class Visit>
void for_cells(const state::Grid& grid, int shift, picture::Vector at, const Visit& visit) {
  const auto end = [&](std::int64_t i, int side) {
    return static_cast<int>(std::min<std::int64_t>((i + 1) << shift, side));
  };
  for (int z = static_cast<int>(at.z << shift); z < end(at.z, grid.z); ++z)
    for (int y = static_cast<int>(at.y << shift); y < end(at.y, grid.y); ++y)
      for (int x = static_cast<int>(at.x << shift); x < end(at.x, grid.x); ++x) visit(x, y, z);
}

}  // namespace

LightMatter light_matter(const DensityField& field, const std::vector<std::int32_t>& ground,
                         const picture::Look& look) {
  const state::Grid& grid = field.grid();
  const picture::Vector cells{grid.x, grid.y, grid.z}, count = picture::light_cells(cells);
  const int shift = picture::light_shift(cells);
  LightMatter of{{count, 0}, {}};
  if (look.glow) of.emission = {count, 0};
  for (std::int64_t z = 0; z < count.z; ++z)
    for (std::int64_t y = 0; y < count.y; ++y)
      for (std::int64_t x = 0; x < count.x; ++x) {
        std::int64_t matter = 0, earth = 0, light = 0;
        const std::int64_t floor = (y << shift) * 4096, height = std::int64_t{4096} << shift;
        for_cells(grid, shift, {x, y, z}, [&](int cx, int cy, int cz) {
          const std::size_t i = grid.index(cx, cy, cz);
          matter += field.intensity()[i];
          if (cy == y << shift && !ground.empty())
            earth += std::clamp<std::int64_t>(
                ground[static_cast<std::size_t>(cz) * static_cast<std::size_t>(grid.x) +
                       static_cast<std::size_t>(cx)] -
                    floor,
                0, height);
          if (look.glow)
            light += picture::emission_of(
                field.liquid()[i],
                picture::matter_of(field.solid()[i], field.liquid()[i], field.heat()[i], 0, look).heat);
        });
        const std::size_t i = of.density.index(x, y, z);
        of.density.cells[i] = static_cast<std::uint8_t>(
            std::max(matter >> (3 * shift + 8), (earth * 255) >> (3 * shift + 12)));
        if (look.glow) of.emission.cells[i] = static_cast<std::uint8_t>(light >> (3 * shift));
      }
  return of;
}

}  // namespace voxmelt::render
