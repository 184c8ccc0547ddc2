// The reference draws the picture by plain loops over render/rule (docs/picture/definition.md). Faster
// programs are checked against it.
#pragma once

#include "render/image/image.h"
#include "render/packet/draw_picture.h"
#include "render/packet/draw_surface.h"
#include "render/reference/picture_scene.h"
#include "render/rule/camera.h"

namespace voxmelt::render {

Image reference_picture(const PictureScene& scene, const picture::Camera& camera, Setting setting);
SurfacePicture reference_surface(const PictureScene& scene, const picture::Camera& camera, Setting setting);

}  // namespace voxmelt::render
