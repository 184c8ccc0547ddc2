// Some inert cells are no ground: walls, posts, basins.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>

#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/reference/picture_scene.h"
#include "render/rule/light_grid.h"
#include "tests/render/shapes.h"
#include "tests/render/sight.h"

namespace voxmelt {
namespace {

using render::DensityField;
using test::Hit;
using test::Point;
using test::Sight;

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

// Makes a wall from the front to the back of the grid, on a floor.
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

Hit hit_of(const Sight& sight, Point from, Point direction = {0, -1, 0}) {
  const std::optional<Hit> hit = sight.find(from, direction);
  EXPECT_TRUE(hit.has_value()) << "no surface";
  return hit.value_or(Hit{});
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
  const Sight sight(field);
  for (double y = 4; y < kWallTop - 2; y += 0.7) {
    const Hit hit = hit_of(sight, {-20, y, 20.3}, {1, 0, 0});
    EXPECT_NEAR(hit.point.x, kWallLeft, 0.1) << y;
    EXPECT_LT(hit.normal.x, -0.99) << y;
  }
  const Hit top = hit_of(sight, {26, 60, 20.3});
  EXPECT_NEAR(top.point.y, kWallTop, 0.1);
  EXPECT_EQ(sight.obstacle(top), 1);
}

TEST(Obstacle, LeavesTheGroundFlatAndDry) {
  // The heights leave out the wall, so the ground of the picture is flat under it.
  const DensityField field = field_of(walled());
  for (const std::int32_t height : field.ground()) EXPECT_EQ(height, test::kFloor * rule::kOne);
  for (const std::int32_t wet : field.wetness()) EXPECT_EQ(wet, 0);
}

// Returns the share of the lamp that reaches a surface.
double lamp_at(const DensityField& field, Point to_light, Point at, Point normal) {
  scene::Light light;
  light.direction = {to_light.x, to_light.y, to_light.z};
  const render::PictureScene scene(field, {}, light, test::floor_terrain(kGrid));
  const picture::Vector before =
      picture::before_surface(test::scaled(at, 20), test::scaled(normal, 14), scene.light.shift());
  return picture::light_at(scene.light, scene.light.count(), scene.light.shift(), before).lamp / 255.0;
}

TEST(Obstacle, CastsAndReceivesShadow) {
  state::Volume volume = walled();
  test::ball(volume, 12, 26, 20, 5);
  const DensityField field = field_of(volume);
  const Point up{0, 1, 0}, from_left{-1, 0.7, 0};
  EXPECT_LT(lamp_at(field, from_left, {34, test::kFloor, 8}, up), 0.1) << "behind the wall";
  EXPECT_GT(lamp_at(field, from_left, {14, test::kFloor, 8}, up), 0.9) << "before the wall";
  const Point to_ball = Point{12, 26, 20} - Point{kWallLeft, 12, 20};
  EXPECT_LT(lamp_at(field, to_ball, {kWallLeft, 12, 20}, {-1, 0, 0}), 0.1) << "on the wall";
  EXPECT_GT(lamp_at(field, to_ball, {kWallLeft, 12, 3}, {-1, 0, 0}), 0.9) << "beside the ball";
}

TEST(Obstacle, LiquidBesideItIsAttached) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 6.5);
  const DensityField field = field_of(volume);
  const Sight sight(field);
  double last = test::kFloor + 6.5;
  for (double x = 15; x < kWallLeft + 2; x += 0.1) {
    const double height = sight.height(x, 20.2);
    EXPECT_GT(height, last - 0.06) << x << ": the surface only rises towards the wall";
    if (x < kWallLeft - 2) {
      EXPECT_NEAR(height, test::kFloor + 6.5, 0.2) << x;
    }
    last = height;
  }
}

TEST(Obstacle, SurfaceRisesWithTheLayerOnIt) {
  double last = 1;
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
    const Sight sight(field);
    const Hit hit = hit_of(sight, {20.3, 60, 20.2});
    EXPECT_NEAR(hit.point.y, 9 + depth, 0.2) << depth;
    // A film of half a cell hides the obstacle. A thinner one lets some of it through.
    const double shown = sight.obstacle(hit);
    EXPECT_LE(shown, depth < 0.5 ? last : 0.1) << depth;
    last = shown;
  }
}

// An obstacle is filtered like a solid. A thin beam stays as it is under a film, however much the liquid is
// smoothed.
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
    return Sight(field).height(20.3, 20.5);
  };
  EXPECT_GT(top_with(6), 16.5);
  EXPECT_NEAR(top_with(6), top_with(1), 0.15);
}

TEST(Obstacle, StandsOnTheGroundWithoutAGap) {
  const DensityField field = field_of(walled());
  const Sight sight(field);
  for (double y = 0.3; y < 4; y += 0.2)
    EXPECT_LT(hit_of(sight, {10, y, 20.3}, {1, 0, 0}).point.x, kWallLeft + 0.1) << y;
}

TEST(Obstacle, ColoursEndWithinACell) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 6);
  const DensityField field = field_of(volume);
  const Sight sight(field);
  const double level = test::kFloor + 6;
  // One point is on the wall a cell above the liquid's edge. One is on the liquid two cells from the wall
  // (the edge is curved).
  EXPECT_GT(sight.obstacle(hit_of(sight, {-20, level + 2, 20.3}, {1, 0, 0})), 0.99);
  EXPECT_LT(sight.obstacle(hit_of(sight, {kWallLeft - 1.5, 60, 20.3})), 0.01);
  // Inside, the places are on either side of the border, and three cells into the liquid.
  EXPECT_LT(sight.matter({kWallLeft - 1, level - 3, 20.3}).obstacle, 148);
  EXPECT_GT(sight.matter({kWallLeft + 1.5, level - 3, 20.3}).obstacle, 204);
  EXPECT_EQ(sight.matter({kWallLeft - 3, level - 3, 20.3}).liquid, 255) << "an obstacle is no solid";
}

// Outside of the grid there is air, which closes the matter that the grid cuts.
TEST(Obstacle, CutFacesAreFlatAndClosed) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 6);
  const DensityField field = field_of(volume);
  const Sight sight(field);
  for (double x = 2; x < kWallRight - 2; x += 0.23)  // two cells inside of the cut
    for (double y = 2.1; y < test::kFloor + 3; y += 0.31) {
      const Point aim{x, y, static_cast<double>(kGrid.z)}, eye{30, 25, 120};
      const Hit hit = hit_of(sight, eye, (aim - eye) * (1 / length(aim - eye)));
      ASSERT_NEAR(hit.point.z, kGrid.z, 0.015) << x << " " << y;
      ASSERT_GT(hit.normal.z, 0.9990) << x << " " << y;  // 2.6 degrees
    }
}

TEST(Obstacle, UpdatesLikeAFreshField) {
  state::Volume volume = walled();
  pour_left_of_wall(volume, 3.4);
  const scene::Terrain terrain = test::floor_terrain(kGrid);
  const scene::Look look;
  DensityField kept;
  kept.update(volume, look, terrain);
  render::Picture kept_picture;
  kept_picture.update(volume, look, {}, terrain, 1);
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
    if (round == 6) block(volume, 4, 9, 2, 9, 4, 9);  // obstacles may change, too
    EXPECT_LT(kept.update(volume, look, terrain), static_cast<int>(kept.bricks().cells()));
    DensityField fresh;
    fresh.update(volume, look, terrain);
    EXPECT_TRUE(kept.intensity() == fresh.intensity());
    EXPECT_TRUE(kept.cells() == fresh.cells());
    const scene::Camera camera = test::small_camera(kGrid);
    kept_picture.update(volume, look, {}, terrain, 1);
    render::Picture fresh_picture;
    fresh_picture.update(volume, look, {}, terrain, 1);
    EXPECT_TRUE(kept_picture.draw(camera, render::Setting::normal, 1) ==
                fresh_picture.draw(camera, render::Setting::normal, 1));
  }
  // Obstacles appear for the first time, or go.
  for (const state::Volume& next : {test::floor_volume(kGrid), walled()}) {
    kept.update(next, look, terrain);
    EXPECT_TRUE(kept.intensity() == field_of(next).intensity());
  }
}

TEST(Obstacle, NoneChangesNothing) {
  const state::Volume volume = test::ball_and_puddle(kGrid);
  const DensityField with = field_of(volume), without = field_of(volume, {});
  EXPECT_FALSE(with.has_obstacles());
  EXPECT_TRUE(with.cells() == without.cells());
  const scene::Camera camera = test::small_camera(kGrid);
  const scene::Terrain terrain = test::floor_terrain(kGrid);
  render::Picture one, other;
  one.update(with, {}, {}, terrain, nullptr, 1);
  other.update(without, {}, {}, terrain, nullptr, 1);
  EXPECT_TRUE(one.draw(camera, render::Setting::normal, 1) == other.draw(camera, render::Setting::normal, 1));
}

}  // namespace
}  // namespace voxmelt
