#include "hwmodel/caster/host/upload.h"

#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/host/memory_image.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/ground_blocks.h"
#include "render/ground/ground_map.h"

namespace voxmelt::hwmodel::raycast {
namespace {

Vec vec_of(const picture::Vector& v) { return {v.x, v.y, v.z}; }

Material material_of(const picture::Material& of) { return {of.diffuse, of.mirror, of.highlight, of.gloss}; }

CameraRegisters camera_of(const render::PictureData& data) {
  const picture::View& view = data.view;
  CameraRegisters of;
  of.eye = vec_of(view.eye), of.forward = vec_of(view.forward);
  of.wide = vec_of(view.wide), of.high = vec_of(view.high);
  of.near_wide = vec_of(view.near_wide), of.near_high = vec_of(view.near_high);
  of.near = view.near;
  of.width = data.width, of.height = data.height;
  of.spacing = data.spacing, of.halvings = view.halvings;
  return of;
}

LookRegisters look_of(const render::PictureData& data) {
  const picture::Paint& paint = *data.paint;
  LookRegisters of;
  of.to_light = vec_of(paint.to_light), of.to_strip = vec_of(paint.to_strip);
  of.lamp = paint.lamp, of.from_below = paint.from_below, of.from_above = paint.from_above;
  of.background = data.background;
  of.solid = material_of(paint.solid), of.liquid = material_of(paint.liquid);
  of.obstacle = material_of(paint.obstacle);
  of.glow = paint.glow, of.obstacles = data.field.obstacles;
  of.clear = paint.clear, of.losses = paint.losses, of.frost = paint.frost;
  of.lamp_low = paint.lamp_low, of.lamp_high = paint.lamp_high, of.strip_low = paint.strip_low;
  of.highlight = paint.highlight, of.dull_highlight = paint.dull_highlight;
  of.surroundings = paint.surroundings;
  of.glow_light = paint.glow_colors.light, of.glow_crust = paint.glow_colors.crust;
  of.tone.assign(data.tone->begin(), data.tone->end());
  of.bytes.assign(data.bytes->begin(), data.bytes->end());
  return of;
}

GroundRegisters ground_of(const render::PictureData& data) {
  const render::GroundMap* map = data.ground.map;
  GroundRegisters of;
  of.any = data.ground.any;
  if (!of.any) return of;
  of.highest = map->highest();
  of.blocks = ground_blocks(data.ground.cells.x, data.ground.cells.z, [&](std::int64_t x, std::int64_t z) {
    return std::int64_t{data.ground.drawn[z * data.ground.row + x]};
  });
  for (std::size_t c = 0; c < 3; ++c) of.color[c] = data.ground.color[c];
  of.textured = !map->texels().empty();
  of.fineness = map->fineness();
  of.bands.assign(map->bands().begin(), map->bands().end());
  of.bends = map->bends();
  return of;
}

SkipMap skip_of(const render::FieldData& field) {
  const state::Grid bricks = lattice_bricks(field);
  SkipMap of;
  of.x = 2 * bricks.x, of.y = 2 * bricks.y, of.z = 2 * bricks.z;
  of.words.resize(static_cast<std::size_t>(of.x) * static_cast<std::size_t>(of.y) *
                  static_cast<std::size_t>(of.z));
  for (std::size_t i = 0; i < of.words.size(); ++i) {
    const std::int32_t record = field.records[i];
    of.words[i] = static_cast<std::uint16_t>((record & 255) + (record < 0 ? 256 : 0));
  }
  of.low = to_lattice(vec_of(field.low)), of.high = to_lattice(vec_of(field.high));
  return of;
}

}  // namespace

Registers registers_of(const render::PictureData& data) {
  Registers of;
  of.cells = vec_of(data.field.cells);
  of.camera = camera_of(data);
  of.look = look_of(data);
  of.ground = ground_of(data);
  of.skip = skip_of(data.field);
  of.light_cells = vec_of(data.light.count);
  of.light_shift = data.light.shift;
  return of;
}

}  // namespace voxmelt::hwmodel::raycast
