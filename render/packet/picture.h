// A drawn scene keeps all that its pictures read up to date, and draws them (docs/picture/definition.md).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/density/density_field.h"
#include "render/ground/ground_map.h"
#include "render/image/image.h"
#include "render/light/light_matter.h"
#include "render/light/light_volume.h"
#include "render/packet/draw_picture.h"
#include "render/packet/draw_surface.h"
#include "render/packet/field_bricks.h"
#include "render/packet/ground_columns.h"
#include "render/rule/shade.h"

namespace voxmelt::render {

class Picture {
 public:
  // Takes over a state. Unchanged parts are kept since the last call. The pictures are those of a fresh
  // object, on any number of threads. A terrain of another size than the volume's counts as none.
  void update(const state::Volume& volume, const scene::Look& look, const scene::Light& light,
              const scene::Terrain& terrain, int threads);
  // Does the same from a field that is kept elsewhere. `changed` lists bricks of the field that were filtered
  // again since the last call, or is null for all. This processor must have `set`.
  void update(const DensityField& field, const scene::Look& look, const scene::Light& light,
              const scene::Terrain& terrain, const std::vector<std::uint32_t>* changed, int threads,
              cpu::InstructionSet set = cpu::widest());

  // Sets the question that is asked before each tile of a picture. Drawing throws Stopped once the answer is
  // yes.
  void stop_when(Stop stop) { stop_ = std::move(stop); }
  Image draw(const scene::Camera& camera, Setting setting, int threads,
             const Packets& packets = best_packets()) const;
  SurfacePicture surface(const scene::Camera& camera, Setting setting, int threads,
                         const Packets& packets = best_packets()) const;

  // These return depths in cells from the eye, and what one pixel shows (draw_surface.h), of draw()'s
  // picture.
  std::vector<float> depths(const scene::Camera& camera, Setting setting, int threads,
                            const Packets& packets = best_packets()) const;
  std::optional<Sight> see(const scene::Camera& camera, Setting setting, int x, int y) const;

  // Tells whether the camera stands in matter or in the ground. Then it sees nothing else.
  bool camera_inside(const scene::Camera& camera) const;

  // Returns the data that pictures are drawn from. It points into this object.
  PictureData data(const picture::Camera& camera, Setting setting) const;

 private:
  DensityField field_;
  scene::Look scene_look_;
  scene::Light scene_light_;
  std::optional<scene::Terrain> terrain_;  // terrain of the last update
  picture::Look look_;
  picture::Paint paint_;
  FieldBricks bricks_;
  GroundMap ground_;
  GroundColumns columns_;
  LightSources sources_;
  LightVolume light_;
  Stop stop_;
  bool obstacles_ = false;
  std::unique_ptr<cpu::Workers> workers_;
};

}  // namespace voxmelt::render
