// A flat face is seen straight from the front. Its matter is cut off by a side of the grid, or ends in it.
// Under nothing but ambient light, and without mirror and highlight, its colour is a product.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "kernel/engine/cpu/instruction_set.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/plain_packet.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"
#include "render/reference/reference_picture.h"

namespace voxmelt {
namespace {

using Light = std::array<double, 3>;

constexpr int kCells = 24, kDepth = 8, kMargin = 4;
const state::Grid kGrid{kCells, kCells, kCells};
const Light kSolid{0.05, 0.05, 0.6}, kLiquid{0.5, 0.25, 0.125}, kGround{0.4, 0.3, 0.2};

struct Side {
  const char* name;
  std::size_t axis;
  bool far;
  double azimuth, elevation;
};
constexpr std::array<Side, 6> kSides{{{"-x", 0, false, -90, 0},
                                      {"+x", 0, true, 90, 0},
                                      {"-y", 1, false, 0, -89},
                                      {"+y", 1, true, 0, 89},
                                      {"-z", 2, false, 180, 0},
                                      {"+z", 2, true, 0, 0}}};

enum class Kind { solid, liquid, obstacle };

// Makes a block whose face is `inset` cells away from the side.
state::Volume block_at(const Side& side, int inset, Kind kind, double temperature = 0) {
  state::Volume volume(kGrid);
  for (int z = 0; z < kCells; ++z)
    for (int y = 0; y < kCells; ++y)
      for (int x = 0; x < kCells; ++x) {
        const std::array<int, 3> at{x, y, z};
        bool inside = true;
        for (std::size_t a = 0; a < 3; ++a) {
          const int low = a != side.axis ? kMargin : side.far ? kCells - inset - kDepth : inset;
          const int high = a != side.axis ? kCells - kMargin : low + kDepth;
          inside = inside && at[a] >= low && at[a] < high;
        }
        if (!inside) continue;
        volume.solid.set(x, y, z, kind == Kind::solid);
        volume.liquid.set(x, y, z, kind == Kind::liquid);
        volume.inert.set(x, y, z, kind == Kind::obstacle);
        const state::Slot i = volume.at(x, y, z);
        volume.amount[i] = kind == Kind::obstacle ? rule::kBedHalf : rule::kOne;
        volume.heat[i] = static_cast<std::uint16_t>(temperature * rule::kTemperatureMax);
      }
  return volume;
}

// Makes a camera that sees four cells in the middle of the block's face.
scene::Camera camera_before(const Side& side, int inset) {
  scene::Camera camera;
  camera.target = {kCells / 2.0, kCells / 2.0, kCells / 2.0};
  camera.target[side.axis] = side.far ? kCells - inset : inset;
  camera.azimuth = side.azimuth;
  camera.elevation = side.elevation;
  camera.distance = 60;
  camera.field_of_view = 4;
  camera.width = camera.height = 6;
  return camera;
}

scene::Look dull_look() {
  scene::Look look;
  look.solid = {kSolid[0], kSolid[1], kSolid[2]};
  look.liquid = {kLiquid[0], kLiquid[1], kLiquid[2]};
  look.ground = {kGround[0], kGround[1], kGround[2]};
  look.specular = look.metallic = 0;
  return look;
}

// All of the ambient light arrives: 0.94, 1 and 1.08 from above, 0.9 of the ground from below, half of both
// from the side.
Light arriving_at(const Side& side) {
  const Light above{0.94, 1.0, 1.08};
  Light light{};
  for (std::size_t c = 0; c < 3; ++c) {
    const double below = 0.9 * kGround[c];
    light[c] = side.axis != 1 ? (above[c] + below) / 2 : side.far ? above[c] : below;
  }
  return light;
}

// Returns the sRGB byte for light that is not pressed.
int byte_of(double light) {
  EXPECT_LT(light, 0.7);
  return static_cast<int>(std::lround(255 * (1.055 * std::pow(light, 1 / 2.4) - 0.055)));
}

void expect_color(const render::Image& image, const Light& light, int most, const std::string& who) {
  for (const render::Rgb& pixel : image.pixels)
    for (std::size_t c = 0; c < 3; ++c)
      ASSERT_NEAR(pixel[c], byte_of(light[c]), most) << who << ", channel " << c;
}

void expect_face(const Side& side, int inset, const state::Volume& volume, const scene::Look& look,
                 const Light& light, int most) {
  SCOPED_TRACE(std::string(side.name) + ", inset " + std::to_string(inset));
  scene::Light ambient;
  ambient.ambient = 1;
  scene::Terrain terrain{kCells, kCells, {}, false};  // nothing is ground
  terrain.height.assign(std::size_t{kCells} * kCells, 0.0f);
  const scene::Camera camera = camera_before(side, inset);

  render::DensityField field;
  field.update(volume, look, terrain);
  const render::PictureScene scene(field, look, ambient, terrain);
  expect_color(reference_picture(scene, render::camera_in_integers(camera), render::Setting::fast), light,
               most, "reference");
  render::Picture picture;
  picture.update(volume, look, ambient, terrain, 1);
  expect_color(picture.draw(camera, render::Setting::fast, 1, render::plain_packets()), light, most, "plain");
  cpu::for_each_instruction_set([&]<cpu::InstructionSet kSet>() {
    if (!cpu::supported(kSet)) return;
    expect_color(picture.draw(camera, render::Setting::fast, 1, render::packets_of(kSet)), light, most,
                 std::string(cpu::name_of(kSet)));
  });
}

Light product(const Light& a, const Light& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

// Takes faces at a side of the grid and inside, with the usual filter and without any. Without a filter, the
// cells of air in front of the face say nothing of their own.
template <class Expect>
void for_each_face(const Expect& expect) {
  for (const Side& side : kSides)
    for (const int inset : {0, 6})
      for (const int passes : {0, 1, 3}) {
        scene::Look look = dull_look();
        look.smooth = passes;
        look.smooth_solid = std::min(passes, 1);
        SCOPED_TRACE(std::to_string(passes) + " passes");
        expect(side, inset, look);
        if (testing::Test::HasFatalFailure()) return;
      }
}

TEST(Face, OfLiquidIsLiquid) {
  for_each_face([](const Side& side, int inset, const scene::Look& look) {
    expect_face(side, inset, block_at(side, inset, Kind::liquid), look, product(kLiquid, arriving_at(side)),
                1);
  });
}

TEST(Face, OfSolidIsSolid) {
  for_each_face([](const Side& side, int inset, const scene::Look& look) {
    expect_face(side, inset, block_at(side, inset, Kind::solid), look, product(kSolid, arriving_at(side)), 1);
  });
}

// The ground's colour goes 12 % of the way to white. It mirrors a little, below a hundredth.
TEST(Face, OfAnObstacleIsAnObstacle) {
  Light own{};
  for (std::size_t c = 0; c < 3; ++c) own[c] = 0.88 * kGround[c] + 0.12;
  for_each_face([&](const Side& side, int inset, const scene::Look& look) {
    expect_face(side, inset, block_at(side, inset, Kind::obstacle), look, product(own, arriving_at(side)), 2);
  });
}

// A crust in ambient light adds to the glow itself: h^1.75, h^4.5 and h^8 with 2.3, 1.15 and 0.2. The heat
// counts in 256 steps, and one step is two bytes of red.
TEST(Face, OfLavaGlows) {
  constexpr double kHeat = 0.4;
  constexpr Light kCold{139 / 4096.0, 119 / 4096.0, 115 / 4096.0},
      kHot{164 / 4096.0, 57 / 4096.0, 33 / 4096.0};
  const Light glow{2.3 * std::pow(kHeat, 1.75), 1.15 * std::pow(kHeat, 4.5), 0.2 * std::pow(kHeat, 8)};
  for_each_face([&](const Side& side, int inset, scene::Look look) {
    look.glow = true;
    look.glow_cold = 0;
    look.glow_hot = 1;
    Light light{};
    for (std::size_t c = 0; c < 3; ++c)
      light[c] = glow[c] + arriving_at(side)[c] * (kCold[c] + (kHot[c] - kCold[c]) * kHeat);
    expect_face(side, inset, block_at(side, inset, Kind::liquid, kHeat), look, light, 3);
  });
}

}  // namespace
}  // namespace voxmelt
