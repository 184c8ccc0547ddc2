// The cells of a field have levels (docs/picture/definition.md, section 6).
#pragma once

#include <cstdint>

#include "render/density/density_field.h"
#include "render/rule/sample.h"

namespace voxmelt::render {

class Levels {
 public:
  explicit Levels(const DensityField& field);

  // Returns the level of any cell. Outside the grid it is that of air.
  std::int32_t operator()(std::int64_t x, std::int64_t y, std::int64_t z) const {
    if (x < 0 || y < 0 || z < 0 || x >= grid_.x || y >= grid_.y || z >= grid_.z) return picture::kAir;
    return levels_[grid_.index(x, y, z)];
  }
  picture::Vector cells() const { return {grid_.x, grid_.y, grid_.z}; }

 private:
  state::Grid grid_;
  Values<std::int16_t> levels_;
};

}  // namespace voxmelt::render
