#include "render/reference/print_trace.h"

#include "render/density/density_field.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"
#include "render/reference/trace.h"

namespace voxmelt::render {

void print_trace(std::ostream& out, const state::Volume& volume, const scene::Look& look,
                 const scene::Light& light, const scene::Terrain& terrain, const scene::Camera& camera,
                 Setting setting, int x, int y) {
  DensityField field;
  field.update(volume, look, terrain, 1);
  const PictureScene scene(field, look, light, terrain);
  TraceText text(out);
  reference_pixel(scene, camera_in_integers(camera), setting, x, y, text);
}

}  // namespace voxmelt::render
