// The ray caster runs in lock-step with the software's reference. They are compared behind every stage, and
// the bytes of the picture with those of the software's packets.
#pragma once

#include "hwmodel/caster/check/picture_run.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::hwmodel::raycast {

// Holds all that is drawn.
struct PictureInput {
  const state::Volume& volume;
  const scene::Look& look;
  const scene::Light& light;
  const scene::Terrain& terrain;
  const scene::Camera& camera;
  render::Setting setting;
};

PictureReport verify_picture(const PictureInput& input, const PictureOptions& options);

}  // namespace voxmelt::hwmodel::raycast
