// The picture's rules run in 64 bits, over the bricks that packets read.
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/packet/field_bricks.h"
#include "render/packet/painter.h"
#include "render/packet/picture_data.h"
#include "render/rule/light_grid.h"
#include "render/rule/matter.h"
#include "render/rule/sample.h"

namespace voxmelt::render {

// Reads the bricks cell by cell.
class PlainCells {
 public:
  explicit PlainCells(const FieldData& field) : field_(field) {}

 protected:
  // Returns the index of a cell's place, or -1 far outside of the grid.
  std::int64_t index(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const picture::Vector place =
        picture::Vector{x, y, z} + picture::Vector{kLatticeBorder, kLatticeBorder, kLatticeBorder};
    if (x < -1 || y < -1 || z < -1 || x > field_.cells.x || y > field_.cells.y || z > field_.cells.z)
      return -1;
    const std::int64_t brick =
        ((place.z >> 3) * field_.bricks_y + (place.y >> 3)) * field_.bricks_x + (place.x >> 3);
    const auto within = [](std::int64_t at) { return (at & 7) + 1; };
    return ((std::int64_t{field_.slots[brick]} * kBrickPlaces + within(place.z)) * kBrickPlaces +
            within(place.y)) *
               kBrickPlaces +
           within(place.x);
  }
  const FieldData& field_;
};

class LevelCells : PlainCells {
 public:
  using PlainCells::PlainCells;
  std::int32_t operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::int64_t at = index(x, y, z);
    return at < 0 ? picture::kAir : field_.levels[at];
  }
};

class MatterOfCells : PlainCells {
 public:
  using PlainCells::PlainCells;
  picture::Matter operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::int64_t at = index(x, y, z);
    if (at < 0) return {};
    const auto byte = [&](int i) { return static_cast<std::int32_t>((field_.matter[at] >> (8 * i)) & 255); };
    return {byte(0), byte(1), byte(2)};
  }
};

struct LightCells {
  const LightData& light;
  picture::Light operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const std::uint8_t* cell = light.cells + 16 * ((z * light.count.y + y) * light.count.x + x);
    picture::Light result;
    result.lamp = cell[0];
    for (std::size_t side = 0; side < picture::kSides; ++side) {
      result.open[side] = cell[1 + side];
      result.glow[side] = cell[8 + side];
    }
    return result;
  }
};

// Calls visit(painter) with a painter of the data.
template <class Visit>
void with_painter(const PictureData& data, const Visit& visit) {
  static const GroundMap kNone;
  const LevelCells levels(data.field);
  const MatterOfCells matter(data.field);
  const LightCells light{data.light};
  const PaintedScene<LevelCells, MatterOfCells, LightCells> scene{
      levels,
      data.field.cells,
      matter,
      data.ground.map != nullptr ? *data.ground.map : kNone,
      light,
      data.light.count,
      data.light.shift,
      *data.paint,
      data.background,
      *data.tone};
  visit(Painter(scene, data.view, data.spacing));
}

}  // namespace voxmelt::render
