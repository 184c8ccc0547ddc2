// A picture that is drawn on a device has the bytes of the host's: in random pictures at the edges of what
// the definition allows, and in scenes in the middle of their melt, from all sides and in every setting.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "kernel/engine/gpu/stepper.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/device/device_picture.h"
#include "render/device/picture_on_device.h"
#include "render/packet/picture.h"
#include "render/reference/picture_scene.h"
#include "tests/kernel/engine/gpu/bus.h"
#include "tests/kernel/engine/gpu/same_steps.h"
#include "tests/kernel/worlds.h"
#include "tests/render/device/devices.h"
#include "tests/render/hostile_picture.h"
#include "tests/render/picture_pairs.h"
#include "tests/rounds.h"

namespace voxmelt::render {
namespace {

// Heat is on, so that the device has it.
rule::Parameters hot() {
  rule::Parameters parameters;
  parameters.heat.enabled = true;
  return parameters;
}

// Returns where the light differs first, or nothing.
std::string difference(const std::vector<LightBytes>& expected, const std::vector<LightBytes>& found) {
  if (expected.size() != found.size()) return "another grid of light";
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::string cell = "cell of light " + std::to_string(i);
    if (expected[i].lamp != found[i].lamp)
      return cell + ": lamp " + std::to_string(expected[i].lamp) + " is " + std::to_string(found[i].lamp);
    if (expected[i].open != found[i].open) return cell + ": openness";
    if (expected[i].glow != found[i].glow) return cell + ": glow";
  }
  return {};
}

// Takes away some of the liquid, so that the ground there is dry.
void dry_some(state::Volume& volume) {
  for (int z = 0; z < volume.grid.z; ++z)
    for (int y = 0; y < volume.grid.y; ++y)
      for (int x = 0; x < volume.grid.x; ++x) {
        if (!volume.liquid.test(x, y, z) || (x / 3 + z / 2) % 2 == 0) continue;
        volume.liquid.set(x, y, z, false);
        volume.amount[volume.at(x, y, z)] = volume.heat[volume.at(x, y, z)] = 0;
      }
}

bool same_picture(const test::HostilePicture& picture, gpu::Stepper& stepper, DevicePicture& drawn) {
  stepper.upload(picture.volume, {});
  drawn.update(stepper.where(), picture.look, picture.light, picture.terrain);
  DensityField field;
  field.update(picture.volume, picture.look, picture.terrain);
  const PictureScene scene(field, picture.look, picture.light, picture.terrain);
  Picture expected;
  expected.update(picture.volume, picture.look, picture.light, picture.terrain, 1);
  const std::string light = difference(scene.light.cells(), drawn.fetch_light());
  const std::string image = test::difference(expected.draw(picture.camera, picture.setting, 1),
                                             drawn.draw(picture.camera, picture.setting));
  EXPECT_EQ(light, "") << test::description(picture);
  EXPECT_EQ(image, "") << test::description(picture);
  return light.empty() && image.empty();
}

// Two states, one after the other.
bool same_hostile_pictures(int seed, const OnDevice& on) {
  SCOPED_TRACE("seed " + std::to_string(seed));
  const auto number = static_cast<std::uint64_t>(seed);
  test::HostilePicture picture = seed % 4 == 3   ? test::hostile_orthographic_picture(number, 6000)
                                 : seed % 4 == 2 ? test::hostile_clear_picture(number, 6000)
                                                 : test::hostile_picture(number, 6000);
  gpu::Stepper stepper(on.device, hot(), picture.volume.grid);
  DevicePicture drawn(on.kernels);
  if (!same_picture(picture, stepper, drawn)) return false;
  dry_some(picture.volume);
  return same_picture(picture, stepper, drawn);
}

// The views are from all sides, from above and below, and every fourth one is from near or within.
scene::Camera view_of(const scene::Scene& scene, int view, int side) {
  constexpr std::array kElevations{28.0, 5.0, 60.0, -30.0, 88.0};
  scene::Camera camera = scene.camera;
  camera.azimuth += 18 * view;
  camera.elevation = kElevations[static_cast<std::size_t>(view) % kElevations.size()];
  camera.distance = view % 4 == 3 ? 0.3 * scene.initial.grid.x : 0;
  camera.width = camera.height = side;
  return camera;
}

// Draws a scene that runs on the device, after some steps and after some more.
void draw_scene(const std::string& name, const std::vector<int>& views, int side) {
  const scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {});
  run::Simulation fast(scene.parameters, scene.initial, run::implementations().widest(), {.threads = 2});
  gpu::Stepper stepper(open_cl().device, scene.parameters, scene.initial.grid);
  stepper.upload(fast.volume(), fast.ledger());
  // A program for any scene, or one for this scene alone.
  DevicePicture drawn(name == "lava"
                          ? std::make_shared<PictureKernels>(open_cl().device, stepper.where().shape)
                          : open_cl().kernels);
  ASSERT_TRUE(device_draws(stepper.where(), scene.look)) << name;
  Picture expected;
  // Slowly, the second state is amid the melt.
  for (const std::uint64_t until :
       {std::uint64_t{100}, all_rounds() ? scene.steps / 3 : std::uint64_t{102}}) {
    while (fast.steps_done() < until) fast.step();
    stepper.upload(fast.volume(), fast.ledger());
    drawn.update(stepper.where(), scene.look, scene.light, scene.terrain);
    expected.update(fast.volume(), scene.look, scene.light, scene.terrain, 2);
    for (const int view : views)
      for (const Setting setting : kSettings) {
        const scene::Camera camera = view_of(scene, view, side);
        ASSERT_EQ(test::difference(expected.draw(camera, setting, 2), drawn.draw(camera, setting)), "")
            << name << ", view " << view << ", " << kSettingNames[static_cast<std::size_t>(setting)]
            << ", after " << until << " steps";
      }
  }
}

// From a picture to the next go the bytes of the image, and numbers of the view, the paint and the columns.
// The state stays.
TEST(KernelsOfThePicture, TheStateStaysWhereItIs) {
  const auto bus = std::make_shared<gpu::Bus>(gpu::plain_device(1, plain_picture_kernels()));
  scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / "bunny_small.toml", {});
  run::Simulation simulation(scene.parameters, scene.initial,
                             worlds::on_device([&](const auto&, const auto&) { return bus; }));
  while (simulation.steps_done() < 40) simulation.step();
  scene.camera.width = scene.camera.height = 24;
  PictureOnDevice drawn;
  std::size_t before = 0;
  for (int frame = 0; frame < 3; ++frame) {
    before = bus->bytes();
    simulation.step();
    ASSERT_TRUE(drawn.update(simulation.state_on_device(), scene.look, scene.light, scene.terrain));
    ASSERT_TRUE(drawn.draw(scene.camera, Setting::normal));
    ASSERT_EQ(drawn.pressed(), 0);
  }
  const state::Grid& grid = scene.initial.grid;
  const std::size_t columns = static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.z);
  EXPECT_LE(bus->bytes() - before, 24 * 24 * 3 + 8 * columns + 2 * 8 * kViewNumbers + 4);
  EXPECT_GT(bus->bytes() - before, 24 * 24 * 3);
}

// Liquid of more than two cells counts where nothing solid or inert is above it, and liquid does not hide it.
TEST(KernelsOfThePicture, KnowWhatIsPressed) {
  const OnDevice on = plain(2);
  state::Volume volume({5, 6, 4});
  gpu::Stepper stepper(on.device, hot(), volume.grid);
  PictureOnDevice drawn;
  const auto pressed = [&] {
    stepper.upload(volume, {});
    EXPECT_TRUE(drawn.update(stepper.where(), {}, {}, {}));
    return drawn.pressed();
  };
  worlds::put(volume, 1, 2, 3, 8192);
  EXPECT_EQ(pressed(), 0) << "two cells";
  worlds::put(volume, 4, 1, 0, 9001);
  worlds::put(volume, 4, 2, 0, 9000);
  worlds::put(volume, 2, 0, 2, 60000);
  EXPECT_EQ(pressed(), 60000);
  worlds::put_inert(volume, 2, 5, 2);
  EXPECT_EQ(pressed(), 9001);
  worlds::put_solid(volume, 4, 2, 0);
  EXPECT_EQ(pressed(), 0);
}

TEST(KernelsOfThePicture, SameHostilePictures) {
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_hostile_pictures(seed, plain(1 + seed % 3))) FAIL();
}

TEST(OpenClPicture, SameHostilePictures) {
  VOXMELT_NEEDS_A_DEVICE();
  for (int seed = 0; seed < rounds(60); ++seed)
    if (!same_hostile_pictures(seed, open_cl())) FAIL();
}

TEST(OpenClPicture, SameViewsOfScenes) {
  VOXMELT_NEEDS_A_DEVICE();
  if (!all_rounds()) {
    for (const char* name : {"lava", "ice"}) draw_scene(name, {3, 9}, 48);
    return;
  }
  std::vector<int> views(20);
  std::iota(views.begin(), views.end(), 0);
  for (const char* name : {"cello", "lava", "bunny", "goblet", "ice", "chocolate_nuts"})
    draw_scene(name, views, 256);
}

}  // namespace
}  // namespace voxmelt::render
