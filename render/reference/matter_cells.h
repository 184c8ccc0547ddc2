// The picture's shading reads the matter of a field's cells in this form (docs/picture/light.md, section 3).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/density/density_field.h"
#include "render/reference/levels.h"
#include "render/rule/matter.h"

namespace voxmelt::render {

class MatterCells {
 public:
  MatterCells(const DensityField& field, const Levels& levels, const picture::Look& look)
      : field_(field), levels_(levels), look_(look) {}

  // Returns the matter of any cell. A cell with the level of air has none.
  picture::Matter operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    const state::Grid& grid = field_.grid();
    if (levels_(x, y, z) == picture::kAir) return {};
    const std::size_t i = grid.index(x, y, z);
    return picture::matter_of(field_.solid()[i], field_.liquid()[i], field_.heat()[i],
                              field_.has_obstacles() ? field_.obstacle()[i] : 0, look_);
  }

 private:
  const DensityField& field_;
  const Levels& levels_;
  const picture::Look& look_;
};

}  // namespace voxmelt::render
