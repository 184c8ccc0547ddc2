// How a surface point reflects the light of the scene.
#pragma once

#include "kernel/scene/look.h"
#include "render/raycast/environment.h"
#include "render/raycast/material.h"
#include "render/raycast/occlusion.h"

namespace voxmelt::render {

// What arrives at the point.
struct Incoming {
  Vec normal;
  Vec to_eye, to_light;
  float lamp = 1;      // share of the lamp's light, 0..1
  float open = 1;      // share of the ambient light
  float mirrored = 1;  // share of the reflected surroundings
  float glow = 0;      // from glowing liquid
};

// Light towards the eye: lamp and ambient half-spheres, Blinn-Phong highlight, mirrored surroundings by
// Fresnel's law (Schlick), emission.
Vec reflected(const Material& material, const Incoming& incoming, float ambient, Vec ground_color);

}  // namespace voxmelt::render
