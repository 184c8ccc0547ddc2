// Pictures by packets of rays agree with the plain loops of the reference, in random hostile scenes and
// cameras.
//
// Planted bugs and the tests that saw them are listed in docs/decisions/picture-packets.md.
#include "render/packet/picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "render/packet/plain_packet.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/reference_picture.h"
#include "tests/render/of_materials.h"
#include "tests/render/shapes.h"

namespace voxmelt {
namespace {

class Random {
 public:
  explicit Random(std::uint32_t seed) : engine_(seed) {}
  int whole(int low, int high) { return std::uniform_int_distribution<int>(low, high)(engine_); }
  double real(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  bool one_in(int n) { return whole(1, n) == 1; }

 private:
  std::mt19937 engine_;
};

struct Hostile {
  state::Volume volume;
  scene::Look look;
  scene::Light light;
  scene::Terrain terrain;
};

void fill_somehow(state::Volume& volume, Random& random, int share) {
  const state::Grid grid = volume.grid;
  const int kind = random.whole(0, 2), low = share == 100 ? rule::kOne : 1;
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        if (random.whole(1, 100) > share || volume.inert.test(x, y, z)) continue;
        const state::Slot i = volume.at(x, y, z);
        const bool liquid = kind == 0 || (kind == 2 && random.one_in(2));
        volume.liquid.set(x, y, z, liquid);
        volume.solid.set(x, y, z, !liquid);
        volume.amount[i] = static_cast<std::uint16_t>(random.whole(low, rule::kOne));
        volume.heat[i] = static_cast<std::uint16_t>(random.whole(0, rule::kTemperatureMax));
      }
}

// Puts boxes of full cells with sharp sides into air. Rays come to them from afar.
void put_boxes(state::Volume& volume, Random& random) {
  const state::Grid grid = volume.grid;
  for (int box = random.whole(1, 5); box > 0; --box) {
    const int x0 = random.whole(0, grid.x - 1), y0 = random.whole(0, grid.y - 1),
              z0 = random.whole(0, grid.z - 1);
    const int x1 = std::min(x0 + random.whole(2, 6), grid.x), y1 = std::min(y0 + random.whole(2, 6), grid.y),
              z1 = std::min(z0 + random.whole(2, 6), grid.z);
    for (int z = z0; z < z1; ++z)
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) {
          if (volume.inert.test(x, y, z) || volume.liquid.test(x, y, z)) continue;
          volume.solid.set(x, y, z, true);
          volume.amount[volume.at(x, y, z)] = rule::kOne;
        }
  }
}

scene::Terrain random_terrain(state::Grid grid, Random& random) {
  scene::Terrain terrain{grid.x, grid.z, {}, random.one_in(2)};
  const double flat = random.whole(0, 2) == 0 ? random.real(0, grid.y) : -1;
  for (int i = 0; i < grid.x * grid.z; ++i)
    terrain.height.push_back(static_cast<float>(flat >= 0 ? flat : random.real(0, grid.y)));
  return terrain;
}

Hostile random_scene(Random& random) {
  constexpr std::array<int, 8> kSides{1, 2, 5, 8, 13, 16, 17, 23};
  const auto side = [&] { return kSides[static_cast<std::size_t>(random.whole(0, 7))]; };
  const state::Grid grid{side(), side(), side()};
  Hostile hostile;
  const bool large = std::min({grid.x, grid.y, grid.z}) >= 13;
  hostile.volume = large && random.one_in(2) ? test::ball_and_puddle(grid) : state::Volume(grid);
  constexpr std::array<int, 5> kShares{0, 2, 20, 60, 100};
  const int share = large && random.one_in(2) ? 0 : kShares[static_cast<std::size_t>(random.whole(0, 4))];
  if (random.one_in(3))
    for (int i = 0; i < grid.x * grid.z; ++i)
      hostile.volume.inert.set(random.whole(0, grid.x - 1), random.whole(0, grid.y - 1),
                               random.whole(0, grid.z - 1), true);
  if (random.one_in(2))
    put_boxes(hostile.volume, random);
  else
    fill_somehow(hostile.volume, random, share);
  if (!random.one_in(3)) hostile.terrain = random_terrain(grid, random);
  hostile.look.smooth = random.whole(0, 3);
  hostile.look.smooth_solid = random.whole(0, 2);
  hostile.look.glow = random.one_in(3);
  hostile.look.metallic = random.whole(0, 2) / 2.0;
  hostile.look.specular = random.real(0, 1);
  hostile.look.shininess = random.whole(1, 200);
  if (!hostile.look.glow && !random.one_in(3)) {
    for (double& half : hostile.look.clear) half = random.one_in(4) ? 0.0 : random.real(0.5, 20);
    hostile.look.frost = random.real(0, 0.5);
  }
  hostile.light.direction = {random.real(-1, 1), random.real(0.1, 1), random.real(-1, 1)};
  return hostile;
}

scene::Camera random_camera(state::Grid grid, Random& random) {
  constexpr std::array<std::array<int, 2>, 6> kSizes{
      {{1, 1}, {17, 33}, {31, 19}, {40, 4}, {3, 70}, {36, 34}}};
  scene::Camera camera;
  const double side = std::max({grid.x, grid.y, grid.z});
  camera.target = {grid.x * random.real(0, 1), grid.y * random.real(0, 1), grid.z * random.real(0, 1)};
  if (random.one_in(3))
    camera.target = {std::floor(camera.target[0]), std::floor(camera.target[1]),
                     std::floor(camera.target[2])};
  camera.azimuth = random.one_in(3) ? 90 * random.whole(0, 3) : random.real(-180, 180);
  camera.elevation = random.one_in(3) ? 45 * random.whole(-2, 2) : random.real(-90, 90);
  camera.distance = random.one_in(4)   ? 0
                    : random.one_in(3) ? random.real(0.1, side)
                                       : random.real(side, 6 * side);
  camera.field_of_view = random.one_in(4) ? random.real(1, 150) : random.real(15, 60);
  const auto size = kSizes[static_cast<std::size_t>(random.whole(0, 5))];
  camera.width = size[0];
  camera.height = size[1];
  if (random.one_in(4)) {  // pixels of the sizes at which rays take finer steps (picture::halvings_of)
    const double near = random.real(1, 4) * side, pixel = random.real(0.03, 0.13);
    camera.distance = near + side / 2;
    const double half = std::atan(pixel * camera.height / 2 / near) * 180 / std::numbers::pi;
    camera.field_of_view = std::clamp(2 * half, 1.0, 150.0);
  }
  return camera;
}

struct NamedPackets {
  std::string name;
  const render::Packets* packets;
};
std::vector<NamedPackets> all_packets() {
  std::vector<NamedPackets> all{{"plain", &render::plain_packets()}};
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
    if (row.supported()) all.push_back({std::string(cpu::name_of(row.set)), &render::packets_of(row.set)});
  return all;
}

std::size_t different(const render::Image& a, const render::Image& b) {
  std::size_t count = a.pixels.size() == b.pixels.size() ? 0 : 1;
  for (std::size_t i = 0; i < std::min(a.pixels.size(), b.pixels.size()); ++i)
    count += a.pixels[i] != b.pixels[i];
  return count;
}

constexpr std::array kSettings{render::Setting::fast, render::Setting::normal, render::Setting::best};

TEST(PictureOfPackets, EqualsTheReferenceInHostileScenes) {
  std::size_t colored = 0;
  std::array<int, 3> halved{};  // pictures by their halvings of the step
  for (std::uint32_t seed = 0; seed < 160; ++seed) {
    Random random(seed);
    Hostile hostile = random_scene(random);
    worlds::Random materials(seed);
    test::any_materials(hostile.look, materials);
    test::of_any_materials(hostile.volume, hostile.look, materials);
    render::DensityField field;
    field.update(hostile.volume, hostile.look, hostile.terrain);
    const render::PictureScene scene(field, hostile.look, hostile.light, hostile.terrain);
    render::Picture picture;
    picture.update(field, hostile.look, hostile.light, hostile.terrain, nullptr,
                   1 + static_cast<int>(seed % 3));
    for (int view = 0; view < 3; ++view) {
      const scene::Camera camera = random_camera(hostile.volume.grid, random);
      const render::Setting setting = kSettings[(seed + static_cast<std::uint32_t>(view)) % 3];
      const picture::Camera integers = render::camera_in_integers(camera);
      const render::Image reference = render::reference_picture(scene, integers, setting);
      const std::size_t background =
          different(reference, render::Image(camera.width, camera.height, reference.at(0, 0)));
      colored += background > 0 ? 1 : 0;
      render::PictureData data = picture.data(integers, setting);
      if (background > 0) ++halved[static_cast<std::size_t>(data.view.halvings)];
      const render::SurfacePicture surface = render::draw_surface(data, render::plain_packets(), 1);
      for (const NamedPackets& set : all_packets())
        for (const bool skip : {true, false}) {
          data.skip = skip;
          const int threads = 1 + static_cast<int>((seed + static_cast<std::uint32_t>(view)) % 8);
          ASSERT_EQ(different(reference, render::draw_picture(data, setting, *set.packets, threads)), 0u)
              << set.name << ", seed " << seed << ", view " << view << ", skip " << skip;
          ASSERT_EQ(surface, render::draw_surface(data, *set.packets, threads))
              << set.name << ", seed " << seed;
        }
    }
  }
  EXPECT_GT(colored, 120u);  // most pictures show something
  for (const int count : halved) EXPECT_GT(count, 30);
}

int packets_not_full = 0, places_elsewhere = 0;

// The data of a tile are narrowed to what its rays may meet. So the lanes of its last packet that are left
// over have rays of the tile, too: one from elsewhere may begin in the midst of matter, and lead anywhere.
TEST(PictureOfPackets, LanesThatAreLeftOverStayInTheirTile) {
  const state::Grid grid{40, 30, 33};
  const render::Picture picture = [&] {
    render::Picture made;
    made.update(test::ball_and_puddle(grid), {}, {}, test::floor_terrain(grid), 1);
    return made;
  }();
  render::Packets watched = render::best_packets();
  watched.draw = [](const render::PictureData& data, render::Places places, render::PressedLight to) {
    const std::size_t last = places.count - 1;
    for (std::size_t i = places.count; i < places.count + render::kMostLanes; ++i)
      places_elsewhere +=
          places.across[i] != places.across[last] || places.down[i] != places.down[last] ? 1 : 0;
    packets_not_full += places.count % render::kMostLanes != 0 ? 1 : 0;
    render::best_packets().draw(data, places, to);
  };
  picture.draw(test::small_camera(grid), render::Setting::normal, 1, watched);
  EXPECT_GT(packets_not_full, 0);
  EXPECT_EQ(places_elsewhere, 0);
}

// The picture is the same if some bricks are taken over, or all.
TEST(PictureOfPackets, TakesOverChangedBricks) {
  const state::Grid grid{40, 30, 33};
  state::Volume volume = test::ball_and_puddle(grid);
  const scene::Terrain terrain = test::floor_terrain(grid);
  scene::Look look;
  look.glow = true;
  look.smooth = look.smooth_solid = 0;  // so that a change stays in its brick
  const scene::Light light;
  render::DensityField field;
  render::Picture picture;
  field.update(volume, look, terrain);
  picture.update(field, look, light, terrain, nullptr, 2);
  Random random(7);
  for (int round = 0; round < 6; ++round) {
    const auto before =
        std::array{field.intensity(), field.solid(), field.liquid(), field.heat(), field.obstacle()};
    if (round == 3)
      volume = test::floor_volume(grid);  // bricks become empty
    else
      test::ball(volume, random.real(3, 37), random.real(5, 27), random.real(3, 30), random.real(1, 5));
    for (int i = 0; i < 8; ++i) {  // at the upper ends of bricks, which the next bricks hold as well
      const int x = 8 * random.whole(1, 4) - 2 + (i & 1) * 4,
                y = 8 * random.whole(1, 2) - 2 + (i >> 1 & 1) * 4,
                z = 8 * random.whole(1, 3) - 2 + (i >> 2) * 4;
      for (int cell = 0; cell < 8; ++cell) {
        const int cx = x + (cell & 1), cy = y + (cell >> 1 & 1), cz = z + (cell >> 2);
        if (volume.liquid.test(cx, cy, cz)) continue;
        volume.solid.set(cx, cy, cz, true);
        volume.amount[volume.at(cx, cy, cz)] = rule::kOne;
      }
    }
    if (round == 4) test::pour(volume, 20, 12, 2.5);
    field.update(volume, look, terrain);
    const auto after =
        std::array{field.intensity(), field.solid(), field.liquid(), field.heat(), field.obstacle()};
    std::vector<std::uint32_t> changed;
    const state::Grid bricks = field.bricks();
    for (std::uint32_t brick = 0; brick < bricks.cells(); ++brick) {
      bool differs = false;
      for (std::size_t i = 0; i < grid.cells(); ++i) {
        const int x = static_cast<int>(i) % grid.x, y = static_cast<int>(i) / grid.x % grid.y,
                  z = static_cast<int>(i) / grid.x / grid.y;
        if (bricks.index(x / 8, y / 8, z / 8) != brick) continue;
        for (std::size_t c = 0; c < before.size(); ++c)
          differs |= !before[c].empty() && before[c][grid.index(x, y, z)] != after[c][grid.index(x, y, z)];
      }
      if (differs) changed.push_back(brick);
    }
    ASSERT_FALSE(changed.empty());
    picture.update(field, look, light, terrain, &changed, 2);
    render::Picture fresh;
    fresh.update(field, look, light, terrain, nullptr, 1);
    for (int view = 0; view < 3; ++view) {
      const scene::Camera camera = random_camera(grid, random);
      const render::Image image = fresh.draw(camera, render::Setting::normal, 1);
      EXPECT_EQ(different(image, picture.draw(camera, render::Setting::normal, 1)), 0u)
          << round << ", " << view;
      EXPECT_EQ(fresh.surface(camera, render::Setting::fast, 1),
                picture.surface(camera, render::Setting::fast, 2));
    }
  }
}

// Rays that do not fit the lanes are drawn all the same.
TEST(PictureOfPackets, DrawsExoticCameras) {
  const state::Grid grid{23, 17, 20};
  const state::Volume volume = test::ball_and_puddle(grid);
  const scene::Terrain terrain = test::floor_terrain(grid);
  const scene::Look look;
  const scene::Light light;
  render::DensityField field;
  field.update(volume, look, terrain);
  const render::PictureScene scene(field, look, light, terrain);
  render::Picture picture;
  picture.update(field, look, light, terrain, nullptr, 1);

  scene::Camera camera = test::small_camera(grid, 1024, 1);
  camera.distance = 100000;
  camera.field_of_view = 120;
  const auto fits = [&] {
    return render::fits_lanes(picture.data(render::camera_in_integers(camera), render::Setting::fast));
  };
  const auto expect_same = [&] {
    const render::Image reference =
        render::reference_picture(scene, render::camera_in_integers(camera), render::Setting::fast);
    for (const NamedPackets& set : all_packets())
      EXPECT_EQ(different(reference, picture.draw(camera, render::Setting::fast, 1, *set.packets)), 0u)
          << set.name;
  };
  EXPECT_FALSE(fits());
  expect_same();
  camera.distance = 30;  // as wide as before, but near
  EXPECT_TRUE(fits());
  expect_same();
  camera = test::small_camera(grid, 64, 64);
  camera.distance = 250000;
  camera.field_of_view = 1;
  EXPECT_TRUE(fits());
  expect_same();
}

// By hand, a camera on the axis z looks at a wall that fills the grid's height, with its front at z = 16.
TEST(PictureOfPackets, DepthAndNormalOfAWall) {
  const state::Grid grid{16, 16, 16};
  state::Volume volume(grid);
  for (int z = 0; z < 16; ++z)
    for (int y = 0; y < 16; ++y)
      for (int x = 0; x < 16; ++x) {
        volume.solid.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = rule::kOne;
      }
  scene::Look look;
  look.smooth = look.smooth_solid = 0;
  render::DensityField field;
  field.update(volume, look);
  render::Picture picture;
  picture.update(field, look, {}, {}, nullptr, 1);
  scene::Camera camera;
  camera.target = {8, 8, 8};
  camera.azimuth = camera.elevation = 0;
  camera.distance = 50;
  camera.field_of_view = 40;
  camera.width = camera.height = 33;
  const render::SurfacePicture surface = picture.surface(camera, render::Setting::fast, 1);
  const std::size_t middle = 16 * 33 + 16;
  // The rays start 1/2 + 3/16 cells before the wall (picture::near_depth), which is 22 of 32nds.
  EXPECT_NEAR(surface.depth[middle], 22, 1);
  EXPECT_EQ(surface.normal[middle], (std::array<std::int16_t, 3>{0, 0, 16384}));
  EXPECT_EQ(surface.depth[0], picture::kNoDepth);
  EXPECT_EQ(surface.normal[0], (std::array<std::int16_t, 3>{0, 0, 0}));
}

}  // namespace
}  // namespace voxmelt
