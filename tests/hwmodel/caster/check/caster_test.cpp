// The ray caster runs in lock-step with the reference of the picture, in hostile pictures and configurations.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

#include "hwmodel/caster/check/expectation.h"
#include "hwmodel/caster/check/verify_picture.h"
#include "render/density/density_field.h"
#include "render/packet/scene_in_integers.h"
#include "tests/kernel/worlds.h"
#include "tests/render/hostile_picture.h"

namespace voxmelt::hwmodel::raycast {
namespace {

Configuration random_configuration(worlds::Random& random) {
  Configuration c;
  c.pipes = random.any({1, 2, 4});
  c.rays = random.any({1, 2, 17, 64});
  c.walkers = random.between(1, 4);
  c.searchers = random.between(1, 4);
  c.bands = random.between(1, 5);
  c.fifo_depth = random.any({1, 2, 8});
  c.stall_seed = random.one_in(2) ? 0 : static_cast<std::uint64_t>(random.between(1, 1000));
  c.tiles = random.any({1, 2, 4});
  for (CacheShape* cache : {&c.levels, &c.matter, &c.light, &c.ground})
    *cache = {random.any({1, 2, 16}), random.any({1, 2, 4}), random.any({8, 20}), random.any({1, 3, 64})};
  c.latency = random.any({1, 5, 60});
  c.bus_bytes = random.any({4, 64, 256});
  c.level_bits = random.between(1, 3);
  c.apron = random.one_in(3);
  return c;
}

std::string text_of(const PictureReport& report) {
  return (report.difference ? text_of(*report.difference) : "") + report.hang +
         std::to_string(report.different_bytes) + " pixels differ";
}

TEST(Caster, HostilePictures) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    test::HostilePicture picture = test::hostile_picture(seed, 3000);
    picture.look.clear = {};
    worlds::Random random(seed + 900);
    PictureOptions options;
    options.configuration = random_configuration(random);
    if (picture.camera.width * picture.camera.height > 500) {  // with a poor machine it would take too long
      options.configuration = {};
      options.configuration.pipes = random.any({1, 2, 4});
      picture.setting = render::Setting::fast;
    }
    if (options.configuration.rays <= 2 && picture.setting != render::Setting::fast) {
      // Each sample waits for the one before: two such pictures took longer than the other 198.
      picture.camera.width = std::min(picture.camera.width, 7);
      picture.camera.height = std::min(picture.camera.height, 7);
    }
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, picture.setting},
        options);
    ASSERT_TRUE(report.good()) << "seed " << seed << ": " << text_of(report) << '\n' << description(picture);
  }
}

// Through clear matter, the bytes and every number of every ray agree with the reference.
TEST(Caster, HostileClearPictures) {
  std::int64_t events = 0, rays = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    test::HostilePicture picture = test::hostile_clear_picture(seed, 3000);
    worlds::Random random(seed + 7900);
    PictureOptions options;
    options.configuration = random_configuration(random);
    picture.camera.width = picture.camera.height = 12 + static_cast<int>(seed % 9);
    if (seed % 5 == 0) {  // with a poor machine it would take too long
      picture.camera.width = picture.camera.height = picture.setting == render::Setting::best ? 3 : 7;
    } else {
      options.configuration.levels = {16, 4, 8, 64};
      options.configuration.rays = random.any({17, 64});
      picture.setting = seed % 5 == 1 ? render::Setting::normal : render::Setting::fast;
    }
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, picture.setting},
        options);
    ASSERT_TRUE(report.good()) << "seed " << seed << ": " << text_of(report) << '\n' << description(picture);
    rays += report.rays;
    for (const StageAccount& stage : report.stages)
      if (stage.name == "passed") events += stage.account.busy;
  }
  EXPECT_GT(events, 3 * rays) << "hardly any ray goes through matter";
}

// Makes a bar of clear matter, and an eye that looks along it.
test::HostilePicture bar_along_x() {
  test::HostilePicture picture;
  picture.volume = state::Volume(state::Grid{20, 16, 20});
  worlds::for_each({2, 2, 2, 12, 14, 18}, [&](int x, int y, int z) {
    picture.volume.solid.set(x, y, z, true);
    picture.volume.amount[picture.volume.at(x, y, z)] = 4096;
  });
  picture.look.clear = {9, 18, 26};
  picture.camera.azimuth = -90;
  picture.camera.elevation = 0;  // along x
  picture.camera.target = {18, 8, 10};
  picture.camera.width = picture.camera.height = 9;
  return picture;
}

// The eye stands in air, and then deeper and deeper in clear matter. A ray that begins in matter crosses no
// surface before it leaves.
TEST(Caster, AnEyeInClearMatterCrossesOneSurface) {
  test::HostilePicture picture = bar_along_x();
  int within = 0;
  for (int i = 0; i < 24; ++i) {
    picture.camera.distance = 5 + i / 12.0;  // the surface is about 6 cells from the target
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, render::Setting::fast},
        {});
    ASSERT_TRUE(report.good()) << i << ": " << text_of(report);
    for (const StageAccount& stage : report.stages)  // every ray passes a way, a surface and the background
      if (stage.name == "passed") within += stage.account.busy == 3 * report.rays ? 1 : 0;
  }
  EXPECT_GE(within, 6);
  EXPECT_LT(within, 24);
}

// The eye is in clear matter, less than a step from its surface, which is 6 cells from the target. A ray
// leaves matter between its first two samples. It crosses the surface there, and not at its start.
TEST(Caster, RaysLeaveClearMatterWithinTheirFirstStep) {
  test::HostilePicture picture = bar_along_x();
  render::DensityField field;
  field.update(picture.volume, picture.look, picture.terrain, 1);
  const render::PictureScene scene(field, picture.look, picture.light, picture.terrain);
  int at_once = 0;
  for (int i = 1; i <= 8; ++i) {
    picture.camera.distance = 6 + i / 256.0;
    const Expectation expectation(scene, render::camera_in_integers(picture.camera), render::Setting::fast);
    for (int pixel = 0; pixel < 81; ++pixel) {
      ExpectedRay ray = expectation.ray(64 * (pixel % 9) + 32, 64 * (pixel / 9) + 32);
      expectation.shade(ray);
      const picture::Crossing* exit = ray.clear.exit(0);
      const bool starts_in = ray.matter.found && ray.matter.sample == 0;
      at_once += starts_in && exit != nullptr && exit->sample == 0 && exit->part < picture::kPlaces ? 1 : 0;
    }
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, render::Setting::fast},
        {});
    ASSERT_TRUE(report.good()) << i << ": " << text_of(report);
  }
  EXPECT_GT(at_once, 300);
}

// In clear matter the rays of `clear_tiles` tiles take turns, and in opaque matter those of `tiles` tiles.
TEST(Caster, ClearMatterHasItsOwnNumberOfTiles) {
  test::HostilePicture picture = bar_along_x();
  picture.camera.width = picture.camera.height = 40;
  const auto cycles = [&](int tiles, int clear_tiles) {
    PictureOptions options;
    options.configuration.tiles = tiles;
    options.configuration.clear_tiles = clear_tiles;
    const PictureReport report = verify_picture(
        {picture.volume, picture.look, picture.light, picture.terrain, picture.camera, render::Setting::fast},
        options);
    EXPECT_TRUE(report.good()) << text_of(report);
    return report.all_cycles;
  };
  EXPECT_EQ(cycles(12, 3), cycles(3, 12));
  EXPECT_NE(cycles(12, 3), cycles(12, 1));
  picture.look.clear = {};
  EXPECT_EQ(cycles(12, 3), cycles(12, 12));
  EXPECT_NE(cycles(12, 3), cycles(3, 3));
}

// The accounts of all stages sum up (verify_picture throws otherwise). Warm caches change no byte, and in the
// second frame lines are still there.
TEST(Caster, WarmCachesDrawTheSame) {
  test::HostilePicture picture = test::hostile_picture(140, 3000);
  picture.look.clear = {};
  PictureOptions options;
  const PictureInput input{picture.volume,  picture.look,   picture.light,
                           picture.terrain, picture.camera, render::Setting::normal};
  const PictureReport cold = verify_picture(input, options);
  options.frames = 2;
  const PictureReport warm = verify_picture(input, options);
  ASSERT_TRUE(cold.good()) << text_of(cold);
  ASSERT_TRUE(warm.good()) << text_of(warm);
  EXPECT_EQ(warm.rays, 2 * cold.rays);
  EXPECT_EQ(warm.samples, 2 * cold.samples);
  EXPECT_LT(warm.memory.reads, 2 * cold.memory.reads);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
