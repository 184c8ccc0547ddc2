// Inert cells that are no ground: walls, posts, basins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>

#include "render/density/density_field.h"
#include "render/raycast/draw.h"
#include "render/raycast/material.h"
#include "render/raycast/occlusion.h"
#include "render/raycast/surface.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using render::DensityField;
using render::Surface;
using render::Vec;

const state::Grid kGrid{48, 32, 40};
constexpr int kWallLeft = 24, kWallRight = 28, kWallTop = 18;

void block(state::Volume& volume, int x0, int x1, int y0, int y1, int z0, int z1) {
  for (int z = z0; z < z1; ++z)
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) {
        volume.inert.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = rule::kBedHalf;
      }
}

// A wall from the front to the back of the grid, on a floor.
state::Volume walled() {
  state::Volume volume = test::floor_volume(kGrid);
  block(volume, kWallLeft, kWallRight, test::kFloor, kWallTop, 0, kGrid.z);
  return volume;
}

void pour_left_of_wall(state::Volume& volume, double height) {
  for (int z = 0; z < kGrid.z; ++z)
    for (int x = 0; x < kWallLeft; ++x) test::pour(volume, x, z, height);
}

scene::Terrain no_terrain() {
  scene::Terrain terrain = test::floor_terrain(kGrid);
  std::fill(terrain.height.begin(), terrain.height.end(), 0.0f);
  return terrain;
}

DensityField field_of(const state::Volume& volume,
                      const scene::Terrain& terrain = test::floor_terrain(kGrid)) {
  DensityField field;
  field.update(volume, {}, terrain);
  return field;
}

render::Material material_below(const DensityField& field, Vec from, Vec direction = {0, -1, 0}) {
  const Surface surface(field, true);
  const auto hit = surface.find({from, direction}, 1000);
  if (!hit) {
    ADD_FAILURE() << "no surface";
    return {};
  }
  return material_at(field, surface.sampler(), hit->point, hit->normal, {});
}

TEST(Obstacle, IsWhatIsInertAboveTheTerrain) {
  const state::Volume volume = walled();
  const auto on_floor = render::cell_fields(volume, 0, test::floor_terrain(kGrid));
  const auto floating = render::cell_fields(volume, 0, no_terrain());
  ASSERT_FALSE(on_floor.obstacle.empty());
  for (int z = 0; z < kGrid.z; ++z)
    for (int y = 0; y < kGrid.y; ++y)
      for (int x = 0; x < kGrid.x; ++x) {
        const std::size_t i = kGrid.index(x, y, z);
        const int full = volume.inert.test(x, y, z) ? render::kFull : 0;
        ASSERT_EQ(on_floor.obstacle[i], y < test::kFloor ? 0 : full) << x << " " << y << " " << z;
        ASSERT_EQ(floating.obstacle[i], full) << x << " " << y << " " << z;
      }
  for (const std::int32_t height : on_floor.columns().ground()) EXPECT_EQ(height, test::kFloor * rule::kOne);
  for (const std::int32_t height : floating.columns().ground()) EXPECT_EQ(height, 0);
  for (const std::uint16_t solid : on_floor.solid) ASSERT_EQ(solid, 0);
}

TEST(Obstacle, FollowsTheRoundedHeightOfATerrain) {
  state::Volume volume = test::floor_volume(kGrid);
  block(volume, 5, 6, test::kFloor, 7, 5, 6);
  scene::Terrain terrain = test::floor_terrain(kGrid);
  const std::size_t hill = 5 * 48 + 5;
  terrain.height[hill] = 4.6f;
  auto fields = render::cell_fields(volume, 0, terrain);
  EXPECT_EQ(fields.obstacle[kGrid.index(5, 4, 5)], 0);
  EXPECT_EQ(fields.obstacle[kGrid.index(5, 5, 5)], render::kFull);
  terrain.height[hill] = 7.2f;
  EXPECT_TRUE(render::cell_fields(volume, 0, terrain).obstacle.empty());
}

TEST(Obstacle, IsDrawnWithoutMatter) {
  const DensityField field = field_of(walled());
  const Surface dry(field, true);
  for (float y = 4; y < kWallTop - 2; y += 0.7f) {
    const auto hit = dry.find({{-20, y, 20.3f}, {1, 0, 0}}, 1000);
    ASSERT_TRUE(hit.has_value()) << y;
    EXPECT_NEAR(hit->point.x, kWallLeft, 0.1) << y;
    EXPECT_LT(hit->normal.x, -0.99f) << y;
  }
  const auto top = dry.find({{26, 60, 20.3f}, {0, -1, 0}}, 1000);
  ASSERT_TRUE(top.has_value());
  EXPECT_NEAR(top->point.y, kWallTop, 0.1);
  const render::Material material = material_below(field, {26, 60, 20.3f});
  const scene::Look look;
  EXPECT_EQ(material.obstacle, 1);
  EXPECT_GE(material.color.x, look.ground[0]);
  EXPECT_LT(material.color.x, look.ground[0] + 0.1);
}

TEST(Obstacle, LeavesTheGroundFlatAndDry) {
  // The heights leave out the wall, so the ground of the picture is flat under it.
  const DensityField field = field_of(walled());
  for (const std::int32_t height : field.ground()) EXPECT_EQ(height, test::kFloor * rule::kOne);
  for (const std::int32_t wet : field.wetness()) EXPECT_EQ(wet, 0);
}

TEST(Obstacle, CastsAndReceivesShadow) {
  state::Volume volume = walled();
  test::ball(volume, 12, 26, 20, 5);
  const DensityField field = field_of(volume);
  const render::Occlusion occlusion(field.pyramid());
  const Vec up{0, 1, 0};
  const Vec from_left = normalized(Vec{-1, 0.7f, 0});
  EXPECT_LT(occlusion.light_reaching({34, test::kFloor, 8}, up, from_left), 0.1f) << "behind the wall";
  EXPECT_GT(occlusion.light_reaching({14, test::kFloor, 8}, up, from_left), 0.9f) << "before the wall";
  const Vec to_ball = normalized(Vec{12, 26, 20} - Vec{kWallLeft, 12, 20});
  EXPECT_LT(occlusion.light_reaching({kWallLeft, 12, 20}, {-1, 0, 0}, to_ball), 0.1f) << "on the wall";
  EXPECT_GT(occlusion.light_reaching({kWallLeft, 12, 3}, {-1, 0, 0}, to_ball), 0.9f) << "beside the ball";
}

TEST(Obstacle, LiquidBesideItIsAttached) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 6.5);
  const DensityField field = field_of(volume);
  const Surface surface(field, true);
  float last = test::kFloor + 6.5f;
  for (float x = 15; x < kWallLeft + 2; x += 0.1f) {
    const auto hit = surface.find({{x, 60, 20.2f}, {0, -1, 0}}, 1000);
    ASSERT_TRUE(hit.has_value()) << x;
    EXPECT_GT(hit->point.y, last - 0.06f) << x << ": the surface only rises towards the wall";
    if (x < kWallLeft - 2) {
      EXPECT_NEAR(hit->point.y, test::kFloor + 6.5, 0.2) << x;
    }
    last = hit->point.y;
  }
}

TEST(Obstacle, SurfaceRisesWithTheLayerOnIt) {
  for (double depth = 0.1; depth < 4; depth += 0.17) {
    state::Volume volume(kGrid);
    block(volume, 0, kGrid.x, 0, 9, 0, kGrid.z);
    for (int z = 0; z < kGrid.z; ++z)
      for (int x = 0; x < kGrid.x; ++x)
        for (int y = 9; depth > y - 9; ++y) {
          volume.liquid.set(x, y, z, true);
          volume.amount[volume.at(x, y, z)] =
              static_cast<std::uint16_t>(std::min(1.0, depth - (y - 9)) * rule::kOne);
        }
    const DensityField field = field_of(volume, no_terrain());
    const auto hit = Surface(field, true).find({{20.3f, 60, 20.2f}, {0, -1, 0}}, 1000);
    ASSERT_TRUE(hit.has_value());
    EXPECT_NEAR(hit->point.y, 9 + depth, 0.2) << depth;
    EXPECT_LT(material_below(field, {20.3f, 60, 20.2f}).obstacle, depth < 0.2 ? 0.6f : 0.1f) << depth;
  }
}

// An obstacle is filtered like a solid: a thin beam stays as it is under a film, however much the liquid
// is smoothed.
TEST(Obstacle, ThinBeamSurvivesUnderAFilm) {
  const auto top_with = [](int smooth) {
    state::Volume volume(kGrid);
    block(volume, 4, 44, 14, 17, 19, 22);
    for (int z = 19; z < 22; ++z)
      for (int x = 4; x < 44; ++x) {
        volume.liquid.set(x, 17, z, true);
        volume.amount[volume.at(x, 17, z)] = rule::kOne * 3 / 10;
      }
    scene::Look look;
    look.smooth = smooth;
    DensityField field;
    field.update(volume, look, no_terrain());
    const auto hit = Surface(field, true).find({{20.3f, 60, 20.5f}, {0, -1, 0}}, 1000);
    return hit ? hit->point.y : -1.0f;
  };
  EXPECT_GT(top_with(6), 16.5f);
  EXPECT_NEAR(top_with(6), top_with(1), 0.15);
}

TEST(Obstacle, StandsOnTheGroundWithoutAGap) {
  const DensityField field = field_of(walled());
  const Surface surface(field, true);
  for (float y = 0.3f; y < 4; y += 0.2f) {
    const auto hit = surface.find({{10, y, 20.3f}, {1, 0, 0}}, 1000);
    ASSERT_TRUE(hit.has_value()) << y;
    EXPECT_LT(hit->point.x, kWallLeft + 0.1f) << y;
  }
}

TEST(Obstacle, ColoursEndWithinACell) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 6);
  const DensityField field = field_of(volume);
  const float level = test::kFloor + 6;
  // One point is on the wall a cell above the liquid's edge. One is on the liquid two cells from the wall
  // (the edge is curved).
  EXPECT_GT(material_below(field, {-20, level + 2, 20.3f}, {1, 0, 0}).obstacle, 0.99f);
  EXPECT_LT(material_below(field, {kWallLeft - 1.5f, 60, 20.3f}).obstacle, 0.01f);
  // On the cut at the front, a cell to either side.
  const auto at_front = [&](float x) { return material_below(field, {x, level - 3, 90}, {0, 0, -1}); };
  EXPECT_LT(at_front(kWallLeft - 1).obstacle, 0.01f);
  EXPECT_GT(at_front(kWallLeft + 1).obstacle, 0.99f);
  EXPECT_EQ(at_front(kWallLeft - 3).liquid, 1) << "an obstacle is no solid";
}

TEST(Obstacle, CutFacesAreFlatAndClosed) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 6);
  const DensityField field = field_of(volume);
  const Surface surface(field, true);
  for (float x = 2; x < kWallRight - 1; x += 0.23f)
    for (float y = 0.4f; y < test::kFloor + 5; y += 0.31f) {
      const Vec aim{x, y, static_cast<float>(kGrid.z)}, eye{30, 25, 120};
      const auto hit = surface.find({eye, normalized(aim - eye)}, 1000);
      ASSERT_TRUE(hit.has_value());
      ASSERT_NEAR(hit->point.z, kGrid.z, 1e-3) << x << " " << y;
      ASSERT_EQ(hit->normal.z, 1) << x << " " << y;
    }
}

TEST(Obstacle, UpdatesLikeAFreshField) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 3.4);
  const scene::Terrain terrain = test::floor_terrain(kGrid);
  const scene::Look look;
  DensityField kept;
  kept.update(volume, look, terrain);
  std::mt19937 random(5);
  const auto pick = [&](int from, int to) {
    return from + static_cast<int>(random() % static_cast<unsigned>(to - from));
  };
  for (int round = 0; round < 10; ++round) {
    for (int change = 0; change < 3; ++change) {
      const int x = pick(18, 34), y = pick(2, 24), z = pick(0, kGrid.z);
      if (volume.inert.test(x, y, z)) continue;
      volume.amount[volume.at(x, y, z)] = static_cast<std::uint16_t>(random() % 5000);
      volume.liquid.set(x, y, z, volume.amount[volume.at(x, y, z)] > 0);
    }
    if (round == 6) block(volume, 4, 9, 2, 9, 4, 9);  // not only matter may change
    EXPECT_LT(kept.update(volume, look, terrain), static_cast<int>(kept.bricks().cells()));
    DensityField fresh;
    fresh.update(volume, look, terrain);
    EXPECT_TRUE(kept.intensity() == fresh.intensity());
    EXPECT_EQ(kept.ranges(), fresh.ranges());
    EXPECT_TRUE(kept.cells() == fresh.cells());
    const scene::Camera camera = test::small_camera(kGrid);
    EXPECT_TRUE(draw(kept, camera, {}, look, terrain) == draw(fresh, camera, {}, look, terrain));
  }
  // Obstacles appear for the first time, or go.
  for (const state::Volume& next : {test::floor_volume(kGrid), walled()}) {
    kept.update(next, look, terrain);
    EXPECT_TRUE(kept.intensity() == field_of(next).intensity());
    EXPECT_EQ(kept.ranges(), field_of(next).ranges());
  }
}

TEST(Obstacle, NoneChangesNothing) {
  const state::Volume volume = test::ball_and_puddle(kGrid);
  const DensityField with = field_of(volume), without = field_of(volume, {});
  EXPECT_FALSE(with.has_obstacles());
  EXPECT_TRUE(with.cells() == without.cells());
  const scene::Camera camera = test::small_camera(kGrid);
  const scene::Terrain terrain = test::floor_terrain(kGrid);
  EXPECT_TRUE(draw(with, camera, {}, {}, terrain) == draw(without, camera, {}, {}, terrain));
}

}  // namespace
}  // namespace voxmelt
