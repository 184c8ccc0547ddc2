// Where the surfaces of a picture are: of all pixels by packets of rays, or of one pixel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/packet/picture_data.h"
#include "render/rule/fixed_point.h"
#include "render/rule/matter.h"

namespace voxmelt::render {

// What the middle of each pixel shows, row by row from the top: its depth (picture::depth_in_picture,
// kNoDepth where there is nothing) and unit normal (2^14 is 1).
struct SurfacePicture {
  int width = 0, height = 0;
  std::vector<std::uint16_t> depth;
  std::vector<std::array<std::int16_t, 3>> normal;

  friend bool operator==(const SurfacePicture&, const SurfacePicture&) = default;
};
SurfacePicture draw_surface(const PictureData& data, const Packets& packets, int threads);

// The same depths in cells from the eye along the direction of view, in 4096ths of a cell and without an end
// (picture::depth_from_eye); infinity where there is nothing. A float holds those below 4096 cells exactly.
std::vector<float> draw_depths(const PictureData& data, const Packets& packets, int threads);

// What the middle of one pixel shows. It is found by picture's rules alone, without packets.
struct Sight {
  bool ground = false;
  picture::Vector position;  // in 2^-20 cells
  picture::Vector normal;    // 2^14 is 1
  picture::Vector step;      // of the ray, in 2^-20 cells
  picture::Matter matter;    // at the position, where it is no ground
};
std::optional<Sight> see_pixel(const PictureData& data, int x, int y);

}  // namespace voxmelt::render
