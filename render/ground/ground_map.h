// The ground of a scene is held in integers, with heights and the texture of rock (docs/picture/ground.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/rule/ground.h"
#include "render/rule/rock.h"

namespace voxmelt::render {

// Heights are in 1 / picture::kHeight of a cell, z outermost.
using ColumnHeights = std::vector<std::int32_t>;
ColumnHeights ground_heights(const scene::Terrain& terrain);

class GroundMap {
 public:
  // Makes a grid without ground.
  GroundMap() = default;
  // Makes the ground of a grid. `cells` is its size, and `passes` are those of the field's low-pass filter.
  // Heights outside of the grid are cut off at it.
  GroundMap(picture::Vector cells, ColumnHeights heights, int passes, const scene::Vec3& color,
            bool textured);

  // Lowers columns under matter. `wetness` is 0 .. kHeight, or empty if all is dry. The call costs little if
  // the wetness is that of the call before. Returns whether anything changed.
  bool lower(const ColumnHeights& wetness);

  // Returns the result of picture::first_ground, with samples left out.
  picture::GroundCrossing find(const picture::Ray& ray) const;

  struct Paint {
    picture::Vector color;   // picture::kColor is 1
    picture::Vector normal;  // with the relief of rock
  };
  Paint paint(const picture::GroundCrossing& crossing) const;

  // These give the parts, for faster programs.
  bool empty() const { return highest_ <= 0; }
  picture::Vector cells() const { return cells_; }
  const ColumnHeights& drawn() const { return drawn_; }  // heights that rays meet
  const ColumnHeights& bare() const { return bare_; }    // before the lowering, for normals
  std::int32_t highest() const { return highest_; }      // highest bare column
  // Returns the largest differences between columns side by side, along x and z.
  picture::Vector slopes() const { return slopes_; }
  const std::vector<picture::Texel>& texels() const { return texels_; }  // none without texture
  int fineness() const { return fineness_; }
  const picture::Vector& color() const { return color_; }
  // These give the noise of bands, and how far they are bent on low_x, high_x, low_z and high_z. There are
  // none without texture.
  const std::vector<std::int16_t>& bands() const { return bands_; }
  const std::array<std::vector<std::int32_t>, 4>& bends() const { return bends_; }

 private:
  void find_slopes();
  void make_texels();
  void make_bands();
  std::size_t column(std::int64_t x, std::int64_t z) const { return z * cells_.x + x; }

  picture::Vector cells_;
  picture::Vector color_;
  int passes_ = 0;
  ColumnHeights softened_;  // filtered, before the pre-filter
  ColumnHeights bare_, drawn_, wetness_;
  std::int32_t highest_ = 0;
  picture::Vector slopes_;
  int fineness_ = 0;
  std::vector<picture::Texel> texels_;
  std::vector<std::int16_t> bands_;                 // upwards, by quarters of a cell
  std::array<std::vector<std::int32_t>, 4> bends_;  // for the columns of low_x, high_x, low_z, high_z
};

}  // namespace voxmelt::render
