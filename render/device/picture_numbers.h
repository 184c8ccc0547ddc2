// The numbers of a picture in the order in which its kernels read them (program/vectors.cl).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/ground/ground_map.h"
#include "render/rule/camera.h"
#include "render/rule/look.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

// Numbers that all rays share, and all cells of light.
using ViewNumbers = std::vector<std::int64_t>;
inline constexpr std::size_t kViewNumbers = 48;

// The lamp's rays go along an axis from slice to slice, and shift along the two others
// (docs/picture/light.md, section 5).
struct LampSweep {
  int axis = 1;
  bool from_high = false;
  std::int32_t slope_u = 0, slope_v = 0;
  std::int64_t slices = 0, low_u = 0, low_v = 0, rays_u = 0, rays_v = 0;
};
LampSweep lamp_sweep(picture::Vector to_light, picture::Vector light_cells);

void put_view(ViewNumbers& numbers, const picture::View& view, const picture::Camera& camera, int spacing);
void put_ground(ViewNumbers& numbers, const GroundMap& ground);
void put_light(ViewNumbers& numbers, const LampSweep& lamp, picture::Vector light_cells, int light_shift);

std::vector<std::int32_t> paint_numbers(const picture::Look& look, const picture::Paint& paint,
                                        int light_shift);
// Heights that are drawn come first, as they change.
std::vector<std::int32_t> ground_numbers(const GroundMap& ground);
std::vector<std::uint16_t> texel_numbers(const GroundMap& ground);  // at least one texel

}  // namespace voxmelt::render
