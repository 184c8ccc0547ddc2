// The ground of a picture in double gives crossing, normal and colour (docs/picture/ground.md), without
// roundings and without steps. Heights of columns, texels and tables are data.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "accuracy/picture/exact_vector.h"
#include "render/reference/picture_scene.h"
#include "render/rule/ground.h"

namespace voxmelt::accuracy {

class ExactGround {
 public:
  explicit ExactGround(const render::PictureScene& scene);

  struct Crossing {
    double place = -1;  // on the ray; negative if there is none
    picture::Face face = picture::Face::none;
  };
  // Returns the first crossing. Above a column's four corners the height is quadratic along the ray, so no
  // crest between samples is lost.
  Crossing first_crossing(const ExactRay& ray) const;

  struct Surface {
    Exact normal, color;
  };
  Surface surface(Exact p, picture::Face face) const;

  double drawn_height(double x, double z) const { return height(drawn_, x, z); }

 private:
  using Heights = std::vector<double>;  // for columns -1 .. n, which repeat the nearest of the grid, in cells
  static constexpr int kBlock = 8;
  std::size_t at(int x, int z) const { return (z + 1) * row_ + (x + 1); }
  double height(const Heights& heights, double x, double z) const;
  double highest_of_block(int x, int z) const;
  Cubic depths_between(const std::array<int, 2>& cell, Exact from, Exact to) const;
  Exact cut_color(Exact p, picture::Face face) const;

  std::array<int, 3> cells_{};
  std::size_t row_ = 0, blocks_x_ = 0;
  Heights drawn_, bare_;
  std::vector<double> block_highest_;
  double highest_ = 0;
  Exact color_;
  int texels_per_cell_ = 0;  // 0 if there are no texels
  const std::vector<picture::Texel>& texels_;
  std::vector<double> bands_;
  std::array<std::vector<double>, 4> bends_;
};

}  // namespace voxmelt::accuracy
