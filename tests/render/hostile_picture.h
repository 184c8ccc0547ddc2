// Makes random pictures at the edges of what docs/picture/definition.md allows: matter, look, lamp, ground,
// camera and setting.
#pragma once

#include <cstdint>
#include <string>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::test {

struct HostilePicture {
  state::Volume volume;
  scene::Look look;
  scene::Light light;
  scene::Terrain terrain;  // counts as none if it does not fit the volume
  scene::Camera camera;
  render::Setting setting = render::Setting::fast;
};

// Makes a picture that is the same on every machine. `most` bounds the number of cells.
HostilePicture hostile_picture(std::uint64_t seed, int most);

// Makes one with clear matter, through which rays see far: obstacles, ground, sides of the grid, surfaces.
HostilePicture hostile_clear_picture(std::uint64_t seed, int most);

// Makes one of parallel rays: the grid fits, or pixels are of the sizes at which rays take finer steps.
HostilePicture hostile_orthographic_picture(std::uint64_t seed, int most);

// Describes the picture in words.
std::string description(const HostilePicture& picture);

}  // namespace voxmelt::test
