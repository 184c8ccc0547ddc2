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

Material material_of(const picture::Material& material) {
  return {material.diffuse, material.mirror, material.highlight, material.gloss};
}

CameraRegisters camera_of(const render::PictureData& data) {
  const picture::View& view = data.view;
  CameraRegisters registers;
  registers.eye = vec_of(view.eye);
  registers.forward = vec_of(view.forward);
  registers.wide = vec_of(view.wide);
  registers.high = vec_of(view.high);
  registers.near_wide = vec_of(view.near_wide);
  registers.near_high = vec_of(view.near_high);
  registers.near = view.near;
  registers.width = data.width;
  registers.height = data.height;
  registers.spacing = data.spacing;
  registers.halvings = view.halvings;
  return registers;
}

LookRegisters look_of(const render::PictureData& data) {
  const picture::Paint& paint = *data.paint;
  LookRegisters registers;
  registers.to_light = vec_of(paint.to_light);
  registers.to_strip = vec_of(paint.to_strip);
  registers.lamp = paint.lamp;
  registers.from_below = paint.from_below;
  registers.from_above = paint.from_above;
  registers.background = data.background;
  registers.solid = material_of(paint.solid);
  registers.liquid = material_of(paint.liquid);
  registers.obstacle = material_of(paint.obstacle);
  registers.glow = paint.glow;
  registers.obstacles = data.field.obstacles;
  registers.clear = paint.clear;
  registers.tinted = paint.tinted;
  registers.losses = paint.losses;
  registers.frost = paint.frost;
  registers.lamp_low = paint.lamp_low;
  registers.lamp_high = paint.lamp_high;
  registers.strip_low = paint.strip_low;
  registers.highlight = paint.highlight;
  registers.dull_highlight = paint.dull_highlight;
  registers.surroundings = paint.surroundings;
  registers.glow_light = paint.glow_colors.light;
  registers.glow_crust = paint.glow_colors.crust;
  for (std::size_t i = 0; i < registers.tints.size(); ++i) registers.tints[i] = material_of(paint.tints[i]);
  registers.tone.assign(data.tone->begin(), data.tone->end());
  registers.bytes.assign(data.bytes->begin(), data.bytes->end());
  return registers;
}

GroundRegisters ground_of(const render::PictureData& data) {
  const render::GroundMap* map = data.ground.map;
  GroundRegisters registers;
  registers.any = data.ground.any;
  if (!registers.any) return registers;
  registers.highest = map->highest();
  registers.blocks =
      ground_blocks(data.ground.cells.x, data.ground.cells.z, [&](std::int64_t x, std::int64_t z) {
        return std::int64_t{data.ground.drawn[z * data.ground.row + x]};
      });
  for (std::size_t c = 0; c < 3; ++c) registers.color[c] = data.ground.color[c];
  registers.textured = !map->texels().empty();
  registers.fineness = map->fineness();
  registers.bands.assign(map->bands().begin(), map->bands().end());
  registers.bends = map->bends();
  return registers;
}

SkipMap skip_of(const render::FieldData& field) {
  const state::Grid bricks = lattice_bricks(field);
  SkipMap map;
  map.x = 2 * bricks.x;
  map.y = 2 * bricks.y;
  map.z = 2 * bricks.z;
  map.words.resize(static_cast<std::size_t>(map.x) * map.y * map.z);
  for (std::size_t i = 0; i < map.words.size(); ++i) {
    const std::int32_t record = field.records[i];
    map.words[i] = static_cast<std::uint16_t>((record & 255) + (record < 0 ? 256 : 0));
  }
  map.low = to_lattice(vec_of(field.low));
  map.high = to_lattice(vec_of(field.high));
  return map;
}

}  // namespace

Registers registers_of(const render::PictureData& data) {
  Registers registers;
  registers.cells = vec_of(data.field.cells);
  registers.camera = camera_of(data);
  registers.look = look_of(data);
  registers.ground = ground_of(data);
  registers.skip = skip_of(data.field);
  registers.light_cells = vec_of(data.light.count);
  registers.light_shift = data.light.shift;
  return registers;
}

}  // namespace voxmelt::hwmodel::raycast
