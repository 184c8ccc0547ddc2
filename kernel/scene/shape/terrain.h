// The terrain is the ground that a scene stands on, as heights. Both the voxels and the renderer take it from
// here.
#pragma once

#include <vector>

namespace voxmelt::scene {

// Holds the height of the ground above y = 0 at the centre of each column, in cells, z outermost.
struct Terrain {
  int x = 0, z = 0;
  std::vector<float> height;
  bool textured = false;  // a height field (drawn with elevation shading) or a flat floor

  friend bool operator==(const Terrain&, const Terrain&) = default;
};

}  // namespace voxmelt::scene
