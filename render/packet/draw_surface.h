// The surfaces of a picture are found for all pixels by packets of rays, or for one pixel.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "render/packet/picture_data.h"
#include "render/rule/fixed_point.h"
#include "render/rule/matter.h"

namespace voxmelt::render {

// Holds what the middle of each pixel shows, row by row from the top. The depth is picture::depth_in_picture,
// and kNoDepth if there is nothing. In the unit normal 2^14 is 1.
struct SurfacePicture {
  int width = 0, height = 0;
  std::vector<std::uint16_t> depth;
  std::vector<std::array<std::int16_t, 3>> normal;

  friend bool operator==(const SurfacePicture&, const SurfacePicture&) = default;
};
SurfacePicture draw_surface(const PictureData& data, const Packets& packets, int threads);

// Returns the same depths in cells from the eye along the direction of view (picture::depth_from_eye). They
// are in 4096ths of a cell, without an upper limit, and infinity if there is nothing. A float holds those
// below 4096 cells exactly.
std::vector<float> draw_depths(const PictureData& data, const Packets& packets, int threads);

// Holds what the middle of one pixel shows. It is found by picture's rules alone, without packets.
struct Sight {
  bool ground = false;
  picture::Vector position;  // in 2^-20 cells
  picture::Vector normal;    // 2^14 is 1
  picture::Vector step;      // step of the ray, in 2^-20 cells
  picture::Matter matter;    // matter at the position, unless it is ground
};
std::optional<Sight> see_pixel(const PictureData& data, int x, int y);

}  // namespace voxmelt::render
