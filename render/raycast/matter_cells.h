// What the cells of a field are made of, as the picture's shading reads it (docs/picture-light.md, section 3).
#pragma once

#include <cstdint>

#include "render/density/density_field.h"
#include "render/rule/matter.h"

namespace voxmelt::render {

class MatterCells {
 public:
  MatterCells(const DensityField& field, const picture::Look& look) : field_(field), look_(look) {}

  // Of any cell; nothing outside the grid.
  picture::Matter operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const state::Grid& grid = field_.grid();
    if (x < 0 || y < 0 || z < 0 || x >= grid.x || y >= grid.y || z >= grid.z) return {};
    const std::size_t i = grid.index(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z));
    return picture::matter_of(field_.solid()[i], field_.liquid()[i], field_.heat()[i],
                              field_.has_obstacles() ? field_.obstacle()[i] : 0, look_);
  }

 private:
  const DensityField& field_;
  const picture::Look& look_;
};

}  // namespace voxmelt::render
