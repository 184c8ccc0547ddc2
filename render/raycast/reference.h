// Depth and normals of a picture by plain loops over render/rule: what faster programs are held against.
#pragma once

#include <cstdint>
#include <vector>

#include "render/packet/scene_in_integers.h"
#include "render/raycast/levels.h"
#include "render/rule/camera.h"

namespace voxmelt::render {

struct SurfacePixel {
  std::uint16_t depth = picture::kNoDepth;  // 32nds of a cell from the near plane
  std::int16_t normal[3] = {0, 0, 0};       // 2^14 is 1
  picture::Vector position;                 // of the crossing
};

// Row by row from the top. The samples of a ray are 2^-spacing cells apart.
std::vector<SurfacePixel> surface_picture(const Levels& levels, const picture::Camera& camera, int spacing);

}  // namespace voxmelt::render
