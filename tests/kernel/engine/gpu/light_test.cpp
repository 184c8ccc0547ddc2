// The kernels of visibility, as C++: the irradiance of each cell, and how a run goes from a device that
// follows rays itself to one that does not.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/engine/visibility/providers.h"
#include "tests/kernel/engine/gpu/bus.h"
#include "tests/kernel/engine/gpu/hostile_world.h"
#include "tests/kernel/engine/gpu/plain_device.h"
#include "tests/kernel/engine/gpu/same_light.h"
#include "tests/rounds.h"

namespace voxmelt::gpu {
namespace {

using namespace worlds;

MakeDevice plain(int threads) {
  return [threads](const Parameters&, Grid) { return plain_device(threads); };
}

TEST(KernelsOfLight, SameIrradianceOfEveryCellByEachKindOfSource) {
  for (const rule::SourceKindRow& kind : rule::kSourceKinds) {
    Lights all;
    for (int seed = 0; seed < rounds(240); ++seed)
      if (!same_light_on_device(seed, &kind, plain(1 + seed % 3), all)) FAIL() << kind.name;
    EXPECT_GT(all.lit, 1000) << kind.name;
    EXPECT_GT(all.dark, 1000) << kind.name;
    EXPECT_GT(all.capped, 100) << kind.name;
    EXPECT_GT(all.rays, 10000) << kind.name;
  }
}

TEST(KernelsOfLight, SameIrradianceOfEveryCellBySourcesOfAllKinds) {
  Lights all;
  for (int seed = 0; seed < rounds(300); ++seed)
    if (!same_light_on_device(seed, nullptr, plain(1 + seed % 3), all)) FAIL();
}

// Both laws, in every step: what melts opens a way, what freezes shuts one, and sources move.
TEST(KernelsOfLight, SameIrradianceInEveryStepOfARun) {
  for (int seed = 0; seed < rounds(120); ++seed) {
    const HostileWorld world = hostile_world(seed, seed % 2 == 0 ? rule::Law::paper : rule::Law::viscous);
    Random random(static_cast<std::uint64_t>(seed));
    const Parameters p = lit_by_any(random, world.parameters, world.start.grid);
    run::Simulation expected(p, world.start, implementation("reference"));
    run::Simulation actual(p, world.start, on_device(plain(1 + seed % 3)));
    ASSERT_TRUE(actual.device_follows_rays());
    for (int step = 0; step < 6; ++step) {
      expected.step();
      actual.step();
      ASSERT_EQ(difference_of_runs(expected, actual), "") << "seed " << seed << ", step " << step;
    }
  }
}

Volume block() {
  Volume v(Grid{40, 12, 16});
  for_each({5, 2, 5, 35, 10, 11}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 25000); });
  return v;
}
Shine sun() {
  return {rule::SourceKind::directional, {.power = std::uint64_t{1} << 20, .direction = {3, 5, 1}}};
}
Shine point() {
  return {rule::SourceKind::point, {.at = {16 * 20, 16 * 14, 16 * 8}, .power = std::uint64_t{1} << 28}};
}
Parameters shone(const std::vector<Shine>& shines, std::uint32_t every) {
  Parameters p = paper_showcase();
  const auto weight = std::uint16_t{8000};
  p.heat = visibility::shone_by(shines, 4, 1);
  p.heat.weight_face = weight;
  p.heat.visibility_every = every;
  return p;
}

// The program has the rays of the sun alone, so the host follows those of a point, and later the device
// again.
TEST(KernelsOfLight, SourcesOfAnotherKindAreTheHosts) {
  run::Simulation expected(shone({sun()}, 2), block(), implementation("reference"));
  run::Simulation actual(shone({sun()}, 2), block(), on_device(plain(1)));
  const auto steps_with = [&](const std::vector<Shine>& shines, bool by_device, bool looks) {
    const rule::Heat heat = shone(shines, 2).heat;
    for (run::Simulation* one : {&expected, &actual}) one->change_sources({heat.sources, {}, {}});
    EXPECT_EQ(actual.device_follows_rays(), by_device);
    for (int step = 0; step < 5; ++step) {
      expected.step();
      actual.step();
      if (!looks) continue;
      ASSERT_EQ(difference_of_runs(expected, actual), "") << "step " << actual.steps_done();
    }
  };
  for (const bool looks : {false, true}) {
    steps_with({sun()}, true, looks);
    steps_with({point()}, false, looks);
    steps_with({sun()}, true, looks);
    steps_with({point()}, false, looks);
    steps_with({}, true, looks);
    steps_with({sun(), point()}, false, looks);
    EXPECT_EQ(difference_of_runs(expected, actual), "") << (looks ? "" : "nobody looked in between");
  }
  EXPECT_GT(expected.volume().liquid.count(), 20) << "nothing has melted: this shows little";
}

// Light stays where it fell until the next step of visibility, also if the parameters change or a hand
// carves, or if another implementation goes on with the run.
TEST(KernelsOfLight, StaysUntilTheNextStepOfVisibility) {
  run::Simulation expected(shone({sun(), point()}, 4), block(), implementation("reference"));
  run::Simulation actual(shone({sun(), point()}, 4), block(), on_device(plain(2)));
  const auto both_step = [&](int count) {
    for (run::Simulation* one : {&expected, &actual}) steps(*one, count);
    ASSERT_EQ(difference_of_runs(expected, actual), "") << "step " << actual.steps_done();
  };
  both_step(2);
  for (run::Simulation* one : {&expected, &actual}) {
    Parameters changed = one->parameters();
    changed.heat.weight_face = 3000;
    one->change_parameters(changed);
  }
  both_step(1);
  for (run::Simulation* one : {&expected, &actual}) one->carve({{16 * 8, 16 * 8, 16 * 8}, 40});
  both_step(1);
  both_step(3);

  run::Simulation resumed(actual.parameters(), actual.volume(), on_device(plain(1)));
  state::MidRun run = actual.mid_run();
  run.irradiance = *actual.irradiance();
  resumed.resume(std::move(run));
  for (run::Simulation* one : {&expected, &resumed}) steps(*one, 1);
  EXPECT_EQ(difference_of_runs(expected, resumed), "") << "before the next step of visibility";
  for (run::Simulation* one : {&expected, &resumed}) steps(*one, 3);
  EXPECT_EQ(difference_of_runs(expected, resumed), "") << "and after it";
}

TEST(KernelsOfLight, WhoIsNamedFollowsTheRays) {
  using Provider = std::unique_ptr<visibility::Provider>;
  run::Simulation usual(shone({sun()}, 1), block(), on_device(plain(1)), {}, visibility::usual_provider(1));
  EXPECT_TRUE(usual.device_follows_rays());
  run::Simulation walk(shone({sun()}, 1), block(), on_device(plain(1)), {},
                       Provider(std::make_unique<visibility::VoxelWalkProvider>()));
  EXPECT_FALSE(walk.device_follows_rays());
  for (run::Simulation* one : {&usual, &walk}) steps(*one, 3);
  EXPECT_TRUE(usual.volume() == walk.volume());
  EXPECT_EQ(walk.casts().asked, 0) << "the plain walk counts none, so nobody else has cast";
  EXPECT_FALSE(
      run::Simulation(shone({sun()}, 1), block(), implementation("reference")).device_follows_rays());
}

TEST(KernelsOfLight, NothingGoesOverTheBus) {
  for (const bool named : {false, true}) {
    const auto bus = std::make_shared<Bus>(plain_device(1));
    const MakeDevice make = [&](const Parameters&, Grid) { return bus; };
    std::unique_ptr<visibility::Provider> walk;
    if (named) walk = std::make_unique<visibility::VoxelWalkProvider>();
    run::Simulation simulation(shone({sun(), point()}, 1), block(), on_device(make), {}, std::move(walk));
    steps(simulation, 2);
    const std::size_t before = bus->bytes();
    steps(simulation, 20);
    if (named)
      EXPECT_GT(bus->bytes(), before + 20 * simulation.volume().grid.cells()) << "masks and irradiance";
    else
      EXPECT_EQ(bus->bytes(), before);
  }
}

}  // namespace
}  // namespace voxmelt::gpu
