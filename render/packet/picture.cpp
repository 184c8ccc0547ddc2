#include "render/packet/picture.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "kernel/engine/cpu/workers.h"
#include "render/light/light_matter.h"
#include "render/packet/scene_in_integers.h"
#include "render/packet/tables.h"

namespace voxmelt::render {

void Picture::update(const state::Volume& volume, const scene::Look& look, const scene::Light& light,
                     const scene::Terrain& terrain, int threads) {
  const bool same = terrain_ && *terrain_ == terrain && scene_look_ == look && scene_light_ == light &&
                    field_.grid() == volume.grid;
  field_.update(volume, look, terrain, threads);
  update(field_, look, light, terrain, same ? &field_.refreshed() : nullptr, threads);
  if (same) return;
  terrain_ = terrain;
  scene_look_ = look;
  scene_light_ = light;
}

void Picture::update(const DensityField& field, const scene::Look& look, const scene::Light& light,
                     const scene::Terrain& terrain, const std::vector<std::uint32_t>* changed, int threads,
                     cpu::InstructionSet set) {
  if (changed != nullptr && changed->empty()) return;
  if (changed == nullptr) {
    look_ = look_in_integers(look);
    paint_ = picture::paint_of(look_, lamp_in_integers(light));
    ground_ = ground_in_integers(field, look, terrain);
    columns_.update(ground_);
  }
  if (ground_.lower(field.wetness())) columns_.lower(ground_);
  const int wanted = std::min(threads, cpu::Workers::most());
  if (workers_ == nullptr || workers_->threads() != wanted) workers_ = std::make_unique<cpu::Workers>(wanted);
  bricks_.update(field, look_, changed, *workers_, brick_loops_of(set));
  obstacles_ = field.has_obstacles();
  sources_.update(field, ground_.drawn(), look_, changed, light_loops_of(set));
  light_.update(sources_.matter(), paint_.to_light, picture::light_shift(bricks_.cells()), *workers_,
                light_loops_of(set));
}

PictureData Picture::data(const picture::Camera& camera, Setting setting) const {
  PictureData data;
  data.view = picture::view_of(camera, bricks_.cells());
  data.width = static_cast<std::int32_t>(camera.width);
  data.height = static_cast<std::int32_t>(camera.height);
  data.spacing = spacing_of(setting, data.view);
  data.field = {bricks_.cells(),        bricks_.bricks().x,
                bricks_.bricks().y,     bricks_.blocks().x,
                bricks_.blocks().y,     bricks_.slots(),
                bricks_.levels(),       bricks_.matter(),
                bricks_.records(),      obstacles_,
                bricks_.occupied().low, bricks_.occupied().high,
                bricks_.shell().data(), bricks_.shell().size()};
  data.light = {reinterpret_cast<const std::uint8_t*>(light_.cells().data()), light_.count(), light_.shift()};
  data.ground = columns_.data(ground_);
  data.paint = &paint_;
  data.background = look_.background;
  data.inverse_root = inverse_roots();
  data.tone = &tone_table();
  data.bytes = &byte_table();
  return data;
}

Image Picture::draw(const scene::Camera& camera, Setting setting, int threads, const Packets& packets) const {
  return draw_picture(data(camera_in_integers(camera), setting), setting, packets, threads, stop_);
}

SurfacePicture Picture::surface(const scene::Camera& camera, Setting setting, int threads,
                                const Packets& packets) const {
  return draw_surface(data(camera_in_integers(camera), setting), packets, threads);
}

std::vector<float> Picture::depths(const scene::Camera& camera, Setting setting, int threads,
                                   const Packets& packets) const {
  return draw_depths(data(camera_in_integers(camera), setting), packets, threads);
}

std::optional<Sight> Picture::see(const scene::Camera& camera, Setting setting, int x, int y) const {
  return see_pixel(data(camera_in_integers(camera), setting), x, y);
}

bool Picture::camera_inside(const scene::Camera& camera) const {
  scene::Camera middle = camera;
  middle.width = middle.height = 1;
  const picture::Camera integers = camera_in_integers(middle);
  if (picture::view_of(integers, bricks_.cells()).near > 0) return false;
  return surface(middle, Setting::fast, 1).depth[0] == 0;
}

}  // namespace voxmelt::render
