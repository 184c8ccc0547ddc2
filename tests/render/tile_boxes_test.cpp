// A ray meets no sample in matter outside of the box of its tile.
#include "render/packet/tile_boxes.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/workers.h"
#include "render/packet/field_bricks.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/levels.h"
#include "tests/kernel/worlds.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

using render::BlockBox;
using state::Grid;
using worlds::Random;

struct Matter {
  explicit Matter(const state::Volume& volume) {
    field.update(volume, {});
    cpu::Workers alone(1);
    bricks.update(field, {}, nullptr, alone);
  }
  render::PictureData seen_by(const scene::Camera& camera) const {
    render::PictureData data;
    data.view = picture::view_of(render::camera_in_integers(camera), bricks.cells());
    data.width = camera.width;
    data.height = camera.height;
    data.field.cells = bricks.cells();
    data.field.low = bricks.occupied().low;
    data.field.high = bricks.occupied().high;
    data.field.shell = bricks.shell().data();
    data.field.shell_count = bricks.shell().size();
    return data;
  }
  render::DensityField field;
  render::FieldBricks bricks;
};

bool holds(const render::FieldData& field, picture::Vector at) {
  return field.low.x <= at.x && at.x < field.high.x && field.low.y <= at.y && at.y < field.high.y &&
         field.low.z <= at.z && at.z < field.high.z;
}

// By hand, the eye stands 100 cells before the origin and looks along -z. The picture is 200 pixels of 64
// places high. Half its height is 100 tan 45 cells at the origin, so a cell there has 64 places.
TEST(Projection, OfABoxBeforeTheEyeByHand) {
  const picture::Camera camera{.target = {},
                               .distance = std::int64_t{100} << 12,
                               .half_field = 45 * picture::kDegree,
                               .width = 300,
                               .height = 200};
  const render::Projection projection(picture::view_of(camera, {8, 8, 8}));
  const std::int64_t cell = picture::kCell;
  const render::VisibleArea area =
      projection.of({10 * cell, 20 * cell, -40 * cell}, {30 * cell, 25 * cell, -11 * cell});
  // With a cell around it the box is 9 to 31 across, 19 to 26 high, and 110 to 141 before the eye.
  const double places = 6400, middle = 9600;
  EXPECT_NEAR(area.left, middle + places * 9 / 141 - 1, 0.1);
  EXPECT_NEAR(area.right, middle + places * 31 / 110 + 1, 0.1);
  EXPECT_NEAR(area.top, places - places * 26 / 110 - 1, 0.1);
  EXPECT_NEAR(area.bottom, places - places * 19 / 141 + 1, 0.1);
}

TEST(TileBoxes, HoldAllMatterThatTheirRaysMeet) {
  int met = 0, empty = 0;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Random random(seed * 7 + 1);
    const Grid grid{random.between(8, 60), random.between(8, 60), random.between(8, 60)};
    state::Volume volume(grid);
    for (int i = 0; i < 3; ++i)
      test::ball(volume, random.below(grid.x), random.below(grid.y), random.below(grid.z),
                 random.between(2, seed % 4 == 0 ? 25 : 6));
    const Matter matter(volume);
    const render::Levels levels(matter.field);
    scene::Camera camera;
    camera.width = random.between(1, 70);
    camera.height = random.between(1, 70);
    camera.azimuth = random.between(0, 359);
    camera.elevation = random.between(-80, 80);
    camera.field_of_view = random.any({5, 30, 90, 140});
    camera.distance = random.one_in(4) ? random.between(1, 20) : random.between(20, 300);
    for (double& at : camera.target) at = random.between(0, 40);
    const render::PictureData data = matter.seen_by(camera);
    constexpr int kSide = 16;
    const render::TileBoxes boxes(data, render::Projection(data.view), kSide);
    for (int i = 0; i < 100; ++i) {
      const int x = random.below(static_cast<int>(camera.width)),
                y = random.below(static_cast<int>(camera.height));
      render::FieldData field_data = data.field;
      if (!boxes.narrow(y / kSide * boxes.across() + x / kSide, field_data)) ++empty;
      const auto place = [&](int pixel) { return pixel * picture::kPixel + random.below(65); };
      const picture::Ray ray = picture::ray_through(data.view, place(x), place(y), 2);
      const picture::Samples in = picture::samples_in(ray, data.field.low, data.field.high);
      for (std::int64_t k = in.first; k <= in.last; ++k) {
        if (picture::sample(levels, ray.at(k)) < 0) continue;
        ++met;
        ASSERT_TRUE(holds(field_data, ray.at(k))) << seed << ": " << x << ", " << y << ", sample " << k;
      }
    }
  }
  EXPECT_GT(met, 2000);
  EXPECT_GT(empty, 200);
}

// Blocks that are full on all sides are not in the shell, and nothing else is missing.
TEST(TileBoxes, ShellIsWhatIsNotSurrounded) {
  state::Volume volume({64, 64, 64});
  test::ball(volume, 32, 32, 32, 26);
  const Matter matter(volume);
  const auto& bricks = matter.bricks;
  const auto occupied = [&](int x, int y, int z) {
    return bricks.blocks().contains(x, y, z) && bricks.records()[bricks.blocks().index(x, y, z)] >= 0;
  };
  std::size_t found = 0;
  for (const BlockBox& box : bricks.shell()) {
    ASSERT_EQ(box.low[0] / 2, (box.high[0] - 1) / 2);  // the box lies in one brick
    for (int z = box.low[2]; z < box.high[2]; ++z)
      for (int y = box.low[1]; y < box.high[1]; ++y)
        for (int x = box.low[0]; x < box.high[0]; ++x) found += occupied(x, y, z) ? 1 : 0;
  }
  std::size_t wanted = 0, inside = 0;
  for (int z = 0; z < bricks.blocks().z; ++z)
    for (int y = 0; y < bricks.blocks().y; ++y)
      for (int x = 0; x < bricks.blocks().x; ++x) {
        if (!occupied(x, y, z)) continue;
        bool surrounded = true;
        for (int b = 0; b < 8; ++b)
          for (int side = -1; side <= 1; side += 2) {
            const int cx = x / 2 * 2 + (b & 1), cy = y / 2 * 2 + (b >> 1 & 1), cz = z / 2 * 2 + (b >> 2);
            surrounded = surrounded && occupied(cx + 2 * side, cy, cz) && occupied(cx, cy + 2 * side, cz) &&
                         occupied(cx, cy, cz + 2 * side);
          }
        (surrounded ? inside : wanted) += 1;
      }
  EXPECT_EQ(found, wanted);
  EXPECT_GT(inside, 100u);
}

}  // namespace
}  // namespace voxmelt
