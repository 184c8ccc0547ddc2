// The ground of a scene is tested: filters by hand, samples left out, pictures that had holes, and the
// texture.
#include "render/ground/ground_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <random>
#include <set>

#include "kernel/scene/scene.h"
#include "render/packet/scene_in_integers.h"
#include "render/rule/camera.h"
#include "tests/render/rule/dense_ground.h"

namespace voxmelt {
namespace {

using picture::Face;
using picture::kCell;
using picture::kHeight;
using picture::Vector;
using render::ColumnHeights;
using render::GroundMap;

const scene::Vec3 kColor{0.5, 0.25, 0.125};

ColumnHeights one_column(std::size_t count, std::size_t at, std::int32_t height) {
  ColumnHeights heights(count, 0);
  heights[at] = height;
  return heights;
}

// A row of seven has one column of 4096. A pass along x gives 1024, 2048, 1024, and along z it changes
// nothing. The pre-filter gives 43 x 1024 = 44032, and so on, each rounded.
TEST(GroundMap, FiltersByHand) {
  const GroundMap map({7, 8, 1}, one_column(7, 3, 4096), 1, kColor, false);
  EXPECT_EQ(map.bare(), (ColumnHeights{0, 172, 1024, 1704, 1024, 172, 0}));
  EXPECT_EQ(map.highest(), 1704);
  const GroundMap along_z({1, 8, 7}, one_column(7, 3, 4096), 1, kColor, false);
  EXPECT_EQ(along_z.bare(), map.bare());
  // The ends repeat. The pass gives 3072 and 1024. The pre-filter gives 2728.. = (43 + 170) x 3072 + 43 x
  // 1024.
  const GroundMap end({3, 8, 1}, {4096, 0, 0}, 1, kColor, false);
  EXPECT_EQ(end.bare(), (ColumnHeights{2728, 1196, 172}));
}

TEST(GroundMap, HeightsEndAtTheGrid) {
  const GroundMap map({3, 2, 1}, {-5000, 3 * kHeight, 0}, 0, kColor, false);
  EXPECT_EQ(map.bare(), GroundMap({3, 2, 1}, {0, 2 * kHeight, 0}, 0, kColor, false).bare());
}

TEST(GroundMap, HeightZeroEverywhereIsNoGround) {
  EXPECT_TRUE(GroundMap().empty());
  const GroundMap map({4, 8, 4}, ColumnHeights(16, 0), 3, kColor, true);
  EXPECT_TRUE(map.empty());
  EXPECT_FALSE(map.find({{kCell, 3 * kCell, kCell}, {0, -kCell / 4, 0}}).found);
}

TEST(GroundMap, WetColumnsAreLowered) {
  GroundMap map({8, 8, 8}, ColumnHeights(64, 2 * kHeight), 2, kColor, false);
  EXPECT_TRUE(map.lower(ColumnHeights(64, kHeight)));
  EXPECT_EQ(map.drawn(), ColumnHeights(64, 2 * kHeight - kHeight / 2));
  EXPECT_EQ(map.bare(), ColumnHeights(64, 2 * kHeight));
  EXPECT_FALSE(map.lower(ColumnHeights(64, kHeight)));
  const picture::GroundCrossing got = map.find({{4 * kCell, 5 * kCell, 4 * kCell}, {0, -kCell / 4, 0}});
  EXPECT_EQ(got.part, (5 * 4 - 6) * 256 + 1);
  EXPECT_TRUE(map.lower({}));
  EXPECT_EQ(map.drawn(), map.bare());
}

// Rough land with needles, some of it under water, is seen from all sides. Leaving samples out changes
// nothing.
TEST(GroundMap, LeavingOutChangesNothing) {
  std::mt19937 random(5);
  const auto any = [&](std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(random);
  };
  std::int64_t met = 0;
  for (int i = 0; i < 60; ++i) {
    const Vector cells{any(1, 70), any(1, 40), any(1, 70)};
    ColumnHeights heights, wetness;
    const std::int64_t kind = any(0, 2), level = any(0, cells.y * kHeight);
    for (std::int64_t c = 0; c < cells.x * cells.z; ++c) {
      const bool rough = kind == 1 || (kind == 2 && any(0, 50) == 0);
      heights.push_back(static_cast<std::int32_t>(rough ? any(0, cells.y * kHeight) : level));
      wetness.push_back(static_cast<std::int32_t>(any(0, 3) == 0 ? any(0, kHeight) : 0));
    }
    GroundMap map(cells, heights, static_cast<int>(any(0, 4)), kColor, false);
    if (any(0, 1) == 1) map.lower(wetness);
    const auto drawn = [&](std::int64_t x, std::int64_t z) {
      return map.drawn()[static_cast<std::size_t>(z * cells.x + x)];
    };
    for (int r = 0; r < 300; ++r) {
      const auto place = [&](std::int64_t side) { return any(-side * kCell / 2, side * kCell * 3 / 2); };
      const Vector from{place(cells.x), place(cells.y), place(cells.z)};
      Vector to{place(cells.x), place(cells.y), place(cells.z)};
      if (r % 5 == 0) to.y = from.y;
      if (r % 7 == 0) to.x = from.x;
      if (picture::largest(to - from) < kCell) continue;
      const picture::Ray ray{from, picture::step_along(to - from, static_cast<int>(any(0, 4)))};
      const picture::GroundCrossing plain = picture::first_ground(drawn, cells, map.highest(), ray),
                                    got = map.find(ray);
      ASSERT_EQ(got.found, plain.found) << i << ' ' << r;
      ASSERT_EQ(got.part, plain.part) << i << ' ' << r;
      ASSERT_EQ(got.position, plain.position);
      ASSERT_EQ(got.face, plain.face);
      met += got.found;
    }
  }
  EXPECT_GT(met, 2000);
}

struct Lava {
  scene::Scene scene = scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / "lava.toml", {});
  Vector cells{scene.initial.grid.x, scene.initial.grid.y, scene.initial.grid.z};
  GroundMap map{cells, render::ground_heights(scene.terrain), scene.look.smooth, scene.look.ground, true};

  picture::View view(double azimuth, double elevation, double distance, int width, int height) const {
    scene::Camera camera = scene.camera;
    camera.azimuth = azimuth;
    camera.elevation = elevation;
    camera.distance = distance;
    camera.width = width;
    camera.height = height;
    return picture::view_of(render::camera_in_integers(camera), cells);
  }
};

// In these views the search in floats overstepped crests. They had a hole through the mountain, and a comb
// along a ridge.
TEST(GroundMap, TheVolcanoHasNoHole) {
  const Lava lava;
  const auto drawn = [&](std::int64_t x, std::int64_t z) {
    return lava.map.drawn()[static_cast<std::size_t>(z * lava.cells.x + x)];
  };
  const test::DenseGround dense(drawn, lava.cells);
  for (const picture::View& view : {lava.view(290, 8, 200, 64, 48), lava.view(65, 12, 70, 64, 48)})
    for (int p = 0; p < 64 * 48; ++p) {
      const picture::Ray ray = picture::ray_through(view, p % 64 * picture::kPixel + picture::kPixel / 2,
                                                    p / 64 * picture::kPixel + picture::kPixel / 2, 2);
      const char* fault = test::fault_of(dense, ray, lava.map.find(ray), 0.02);
      ASSERT_EQ(fault, nullptr) << fault << ", ray " << p;
    }
}

// From straight below, each ray that meets anything meets the underside, which is plain.
TEST(GroundMap, FromBelowTheUndersideHidesAll) {
  const Lava lava;
  const picture::View view = lava.view(30, -89, 300, 64, 48);
  int met = 0;
  std::set<std::int64_t> reds;
  for (int p = 0; p < 64 * 48; ++p) {
    const picture::GroundCrossing got =
        lava.map.find(picture::ray_through(view, p % 64 * picture::kPixel + picture::kPixel / 2,
                                           p / 64 * picture::kPixel + picture::kPixel / 2, 2));
    if (!got.found || got.face != Face::under) continue;
    ++met;
    const GroundMap::Paint paint = lava.map.paint(got);
    EXPECT_EQ(paint.normal, (Vector{0, -(1 << picture::kNormalBits), 0}));
    reds.insert(paint.color.x);
  }
  EXPECT_GT(met, 700);
  EXPECT_EQ(reds.size(), 1u);
}

// At the middle of a texel its own colour is seen, and midway between two their mean.
TEST(GroundMap, TexelsAreSeenWhereTheyLie) {
  const Lava lava;
  ASSERT_EQ(lava.map.fineness(), 2);
  const std::int64_t columns = lava.cells.x * 4;
  const auto red = [&](std::int64_t i, std::int64_t j) {
    return std::int64_t{lava.map.texels()[static_cast<std::size_t>(j * columns + i)].red};
  };
  const auto painted = [&](std::int64_t x, std::int64_t z) {
    return lava.map.paint({true, 1, {x, 0, z}, Face::top}).color.x;
  };
  for (const std::int64_t i : {0, 1, 77, 200, 510}) {
    const std::int64_t x = picture::texel_middle(i, 2), z = picture::texel_middle(300, 2);
    EXPECT_EQ(painted(x, z), red(i, 300));
    EXPECT_EQ(painted(x + kCell / 8, z), (red(i, 300) + red(i + 1, 300) + 1) >> 1);
    EXPECT_EQ(painted(z, x), red(300, i));
  }
}

// On level rock a bump compares the relief one texel before and behind, along each axis.
TEST(GroundMap, BumpsOfLevelRock) {
  const GroundMap map({16, 8, 16}, ColumnHeights(256, 2 * kHeight), 0, kColor, true);
  const auto relief = [](std::int64_t i, std::int64_t j) {
    return picture::relief({picture::texel_middle(i, 2), 2 * kCell, picture::texel_middle(j, 2)});
  };
  for (const std::int64_t i : {0, 5, 63})
    for (const std::int64_t j : {0, 17, 63}) {
      const picture::Texel& texel = map.texels()[static_cast<std::size_t>(j * 64 + i)];
      EXPECT_EQ(texel.bump_x, picture::bump(relief(i - 1, j), relief(i + 1, j), 2)) << i << ' ' << j;
      EXPECT_EQ(texel.bump_z, picture::bump(relief(i, j - 1), relief(i, j + 1), 2)) << i << ' ' << j;
    }
}

// Beside a puddle the ground is lower, but its light is that of the dry ground.
TEST(GroundMap, APuddleDoesNotBendTheLightBesideIt) {
  GroundMap map({16, 8, 16}, ColumnHeights(256, 2 * kHeight), 2, kColor, false);
  map.lower(one_column(256, 8 * 16 + 8, kHeight));
  EXPECT_LT(map.drawn()[8 * 16 + 9], map.bare()[8 * 16 + 9]);
  EXPECT_EQ(map.paint({true, 1, {9 * kCell, kCell, 8 * kCell}, Face::top}).normal, (Vector{0, 1 << 14, 0}));
}

// Rock is neither plain nor wild: each colour lies near the look's, and bumps are a few degrees.
TEST(GroundMap, TexelsAreNearTheLooksColor) {
  const Lava lava;
  double red = 0, bump = 0;
  int lowest = 65535, highest = 0;
  for (const picture::Texel& texel : lava.map.texels()) {
    red += texel.red / 4096.0;
    bump += texel.bump_x * texel.bump_x / 65536.0;
    lowest = std::min<int>(lowest, texel.green);
    highest = std::max<int>(highest, texel.green);
  }
  const auto count = static_cast<double>(lava.map.texels().size());
  EXPECT_EQ(count, 512 * 512);
  EXPECT_NEAR(red / count, 0.34, 0.06);
  EXPECT_GT(lowest, 0.32 * 4096 / 3);
  EXPECT_LT(highest, 0.32 * 4096 * 1.3);
  EXPECT_NEAR(bump / count, 0.004, 0.0035);  // an angle of 1.3 to 5 degrees
}

TEST(GroundMap, FloorsArePlainAndTheirSidesDarker) {
  const GroundMap map({16, 8, 16}, ColumnHeights(256, 2 * kHeight), 3, kColor, false);
  const auto painted = [&](Face face) { return map.paint({true, 1, {8 * kCell, kCell, 8 * kCell}, face}); };
  EXPECT_EQ(painted(Face::top).color, (Vector{2048, 1024, 512}));
  EXPECT_EQ(painted(Face::top).normal, (Vector{0, 1 << 14, 0}));
  EXPECT_EQ(painted(Face::low_z).color, (Vector{1270, 635, 317}));
  EXPECT_EQ(painted(Face::under).color, (Vector{1270, 635, 317}));
}

// The bands of a side are the noise of quarters of a cell, moved by the bend of the column.
TEST(GroundMap, BandsAreBent) {
  const GroundMap map({16, 8, 16}, ColumnHeights(256, 6 * kHeight), 3, {1, 1, 1}, true);
  for (const std::int64_t z : {2, 9}) {
    const std::int64_t middle = picture::texel_middle(z, 0);
    for (const std::int64_t i : {6, 13, 20}) {
      const std::int64_t y = picture::texel_middle(i, 2) - picture::bend({16 * kCell, 0, middle});
      EXPECT_EQ(map.paint({true, 1, {16 * kCell - 1, y, middle}, Face::high_x}).color,
                picture::cut_color({4096, 4096, 4096}, picture::band(i)));
    }
  }
}

}  // namespace
}  // namespace voxmelt
