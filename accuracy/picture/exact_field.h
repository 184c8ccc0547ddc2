// The field of a picture in double gives sample, first crossing, normal and matter
// (docs/picture/definition.md, sections 6 to 8), without roundings and without steps. The levels and the
// cells' bytes are data.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "accuracy/picture/exact_vector.h"
#include "render/reference/picture_scene.h"

namespace voxmelt::accuracy {

class ExactField {
 public:
  explicit ExactField(const render::PictureScene& scene);

  double level(Exact p) const;
  // Returns the first place of the ray with a level of 0 or more, or a negative number. Within a cell the
  // level is a cubic along the ray, so nothing between two samples is lost.
  double first_crossing(const ExactRay& ray) const;
  Exact normal(Exact p) const;
  struct Matter {
    double liquid = 0, heat = 0, obstacle = 0;  // 0 .. 255
  };
  Matter matter(Exact p) const;
  bool obstacles() const { return obstacles_; }

  // Returns how many cells the nearest sample that may be matter is away from a lower cell -1 .. n - 1. It
  // counts the largest difference of an axis; 0 means in the cell itself.
  int distance(std::int64_t x, std::int64_t y, std::int64_t z) const {
    return far_[at(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z))];
  }

 private:
  static constexpr int kBorder = 2;
  // Indexes cells -2 .. n + 1.
  std::size_t at(int x, int y, int z) const {
    return ((z + kBorder) * side_[1] + (y + kBorder)) * side_[0] + (x + kBorder);
  }
  void find_distances();
  Cubic levels_between(const std::array<int, 3>& cell, Exact from, Exact to) const;

  std::array<int, 3> cells_{};
  std::array<std::size_t, 3> side_{};
  std::vector<float> levels_;
  std::vector<std::array<std::uint8_t, 3>> matter_;
  std::vector<std::uint8_t> far_;
  bool obstacles_ = false;
};

}  // namespace voxmelt::accuracy
