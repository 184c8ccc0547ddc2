// The timing of pictures is tested: it refuses wrong ones, its states go there and back, and its arithmetic
// is right.
#include "measure/drawing.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "kernel/run/simulation.h"
#include "measure/finer_grids.h"
#include "measure/measure.h"
#include "measure/melt_film.h"
#include "measure/two_states.h"
#include "tests/measure/melting_drop.h"

namespace voxmelt::measure {
namespace {

scene::Scene drop_scene() {
  baseline::MeltingDrop drop = baseline::melting_drop();
  scene::Scene scene;
  scene.name = "drop";
  scene.steps = 60;
  scene.parameters = drop.parameters;
  scene.initial = drop.volume;
  return scene;
}

Workload middle_of_drop(const scene::Scene& scene) { return scene_at(scene, 50, 1); }

// Draws with the packets of this processor and one fault: the last place of every call is a shade too red.
void draw_a_shade_too_red(const render::PictureData& data, render::Places places, render::PressedLight to) {
  render::best_packets().draw(data, places, to);
  to.red[places.count - 1] = static_cast<std::uint16_t>(to.red[places.count - 1] ^ 2048);
}

TEST(Drawing, AWrongPictureIsNotTimed) {
  const scene::Scene scene = drop_scene();
  const Workload workload = middle_of_drop(scene);
  const Drawer sound = drawer_of(cpu::widest());
  const render::Packets packets{&draw_a_shade_too_red, render::best_packets().find,
                                render::best_packets().lanes};
  const Drawer wrong{cpu::widest(), &packets};
  EXPECT_NO_THROW(measure_drawing(workload, scene, {sound}, {1}, {1, 0}));
  for (const std::vector<Drawer>& drawers : {std::vector{wrong}, std::vector{sound, wrong}}) {
    try {
      measure_drawing(workload, scene, drawers, {1}, {1, 0});
      FAIL() << "the fault went unnoticed";
    } catch (const Mismatch& error) {
      EXPECT_NE(std::string(error.what()).find("plain painter"), std::string::npos) << error.what();
    }
  }
}

TEST(Drawing, EveryPartOfEverySetIsTimed) {
  const scene::Scene scene = drop_scene();
  const Drawing drawing =
      measure_drawing(middle_of_drop(scene), scene, {drawer_of(cpu::widest())}, {1, 2}, {3, 0});
  ASSERT_EQ(drawing.timings.size(), 2U);
  EXPECT_EQ(drawing.timings[1].threads, 2);
  EXPECT_EQ(drawing.rounds, 3);
  EXPECT_GT(drawing.bricks, 0);
  EXPECT_LE(drawing.bricks, 4 * 3 * 4);
  EXPECT_GT(drawing.rays[0], 0);
  EXPECT_LE(drawing.rays[0], std::int64_t{kPictureSide} * kPictureSide);
  for (const DrawingTiming& timing : drawing.timings) {
    EXPECT_GT(timing.field, timing.unchanged);
    EXPECT_GT(timing.light, 0);
    for (const double seconds : timing.draw) EXPECT_GT(seconds, 0);
  }
}

TEST(Drawing, NanosecondsPerRayAreTheTimeOverTheRays) {
  Drawing drawing;
  drawing.rays = {200, 400, 1000};
  DrawingTiming timing;
  timing.draw = {1e-6, 4e-6, 3e-6};
  EXPECT_DOUBLE_EQ(drawing.nanoseconds_per_ray(timing, 0), 5);
  EXPECT_DOUBLE_EQ(drawing.nanoseconds_per_ray(timing, 2), 3);
}

TEST(TwoStates, GoThereAndBackAndTellEveryChange) {
  const scene::Scene scene = drop_scene();
  const Workload workload = middle_of_drop(scene);
  run::Simulation simulation(workload.parameters, workload.start, run::implementations().widest());
  for (int i = 0; i < workload.lead_steps; ++i) simulation.step();
  const state::Volume before = simulation.volume();
  for (int i = 0; i < 3; ++i) simulation.step();
  const state::Volume after = simulation.volume();
  ASSERT_FALSE(before.amount == after.amount);

  TwoStates states(workload, 3);
  for (int round = 0; round < 2; ++round) {
    EXPECT_TRUE(states.before() == before);
    const state::ChangedBricks::Seen seen = states.now().changed.now();
    EXPECT_TRUE(states.after() == after);
    ASSERT_FALSE(states.now().changed.all_since(seen));
    const state::Grid bricks = state::brick_grid(after.grid);
    worlds::for_each(worlds::whole(after.grid), [&](int x, int y, int z) {
      const state::Slot i = after.at(x, y, z);
      if (before.amount[i] == after.amount[i] && before.heat[i] == after.heat[i]) return;
      EXPECT_TRUE(
          states.now().changed.since(state::ChangedBricks::kHeat, seen, bricks.index(x / 8, y / 8, z / 8)))
          << x << ' ' << y << ' ' << z;
    });
  }
}

TEST(FinerGrids, GrowthIsToTheGridBefore) {
  const auto grid = [](double normal) {
    FinerGrid finer_grid;
    finer_grid.timings = {{cpu::widest(), 1, normal}};
    return finer_grid;
  };
  const std::vector<FinerGrid> grids{grid(0.02), grid(0.03), grid(0.015)};
  EXPECT_FALSE(growth_of_normal(grids, 0, 0));
  EXPECT_DOUBLE_EQ(*growth_of_normal(grids, 1, 0), 1.5);
  EXPECT_DOUBLE_EQ(*growth_of_normal(grids, 2, 0), 0.5);
}

TEST(FinerGrids, AreDrawnAfterTheirStep) {
  const scene::Scene scene = drop_scene();
  const std::vector<FinerGrid> grids =
      measure_finer_grids({scene, scene}, {drawer_of(cpu::widest())}, 1, {2, 0}, 7);
  ASSERT_EQ(grids.size(), 2U);
  EXPECT_EQ(grids[0].scene, "scene:drop/step:7");
  EXPECT_GT(grids[1].timings[0].normal, 0);
}

TEST(MeltFilm, HasAllStepsInAllFrames) {
  const MeltFilm film = measure_melt_film(drop_scene(), 40, 2, 2);
  EXPECT_EQ(film.frames, 40);
  EXPECT_EQ(film.steps, 60U);
  EXPECT_EQ(film.rounds, 2);
  EXPECT_GT(film.seconds, 0);
  EXPECT_GT(film.processor_seconds, 0);
}

}  // namespace
}  // namespace voxmelt::measure
