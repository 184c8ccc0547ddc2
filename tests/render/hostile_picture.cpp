#include "tests/render/hostile_picture.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <sstream>

#include "tests/kernel/worlds.h"
#include "tests/render/of_materials.h"

namespace voxmelt::test {
namespace {

using worlds::Random;

double fraction(Random& random) { return static_cast<double>(random.bits() >> 11) * 0x1p-53; }
double between(Random& random, double low, double high) { return low + (high - low) * fraction(random); }
// This is just below half of a unit of light: the sum with 1/2 rounds to 1 in doubles.
constexpr double kBelowHalf = 0x1.fffffffffffffp-2 * 0x1p-12;
constexpr double kBelowHalfClear = 0x1.fffffffffffffp-2 * 0x1p-6;  // the same part of a unit of `clear`

// Returns a number from 0 to 1, often an end.
double edged(Random& random) {
  return random.one_in(3) ? random.any({0.0, 0.0, 1.0, 1.0, kBelowHalf}) : fraction(random);
}

// The sizes lie beside those of bricks, blocks and words. Some are thin, and some are a single cell.
state::Grid hostile_grid(Random& random, int most) {
  const auto side = [&] {
    return random.any({1, 2, 3, 7, 8, 9, 12, 15, 16, 17, 23, 24, 25, 31, 32, 33, 64, 65});
  };
  if (random.one_in(12)) return {1, 1, 1};
  state::Grid grid{side(), side(), side()};
  if (random.one_in(6)) (random.one_in(2) ? grid.x : grid.z) = random.any({127, 128, 129, 257});
  while (grid.cells() > static_cast<std::size_t>(most)) {
    int& longest = grid.x >= grid.y && grid.x >= grid.z ? grid.x : grid.y >= grid.z ? grid.y : grid.z;
    longest = std::max(1, longest * 2 / 3);
  }
  return grid;
}

enum Kind { kAir, kSolid, kLiquid, kInert };

void put(state::Volume& volume, int x, int y, int z, int kind, Random& random) {
  volume.solid.set(x, y, z, kind == kSolid);
  volume.liquid.set(x, y, z, kind == kLiquid);
  volume.inert.set(x, y, z, kind == kInert);
  const state::Slot at = volume.at(x, y, z);
  const int full = random.any({4096, 4096, 4095, 1, 6000, 65535, 2048, 100});
  volume.amount[at] = static_cast<std::uint16_t>(kind == kAir     ? 0
                                                 : kind == kInert ? random.any({2048, 1, 0, 4096, 3000, 8191})
                                                 : random.one_in(2) ? full
                                                                    : random.between(1, 4096));
  volume.heat[at] = static_cast<std::uint16_t>(
      kind == kSolid || kind == kLiquid ? random.one_in(3) ? random.any({0, 65535}) : random.below(65536)
                                        : 0);
}

// Fills in lumps of one kind, with single cells amid them.
void fill_lumps(state::Volume& volume, Random& random) {
  const int size = random.any({1, 2, 4, 5, 8}), noise = random.any({2, 10, 1000}),
            air = random.any({1, 2, 6});
  const std::uint64_t salt = random.bits();
  worlds::for_each(worlds::whole(volume.grid), [&](int x, int y, int z) {
    Random lump(salt + static_cast<std::uint64_t>(x / size + 300 * (y / size) + 90000 * (z / size)));
    int kind = lump.below(4 + air);
    if (random.one_in(noise)) kind = random.below(4);
    put(volume, x, y, z, kind <= kInert ? kind : kAir, random);
  });
}

// Fills in ground with obstacles, films and puddles on it, and solids that hang.
void fill_land(state::Volume& volume, const scene::Terrain& terrain, Random& random) {
  const int film = random.any({2, 3, 8}), rough = random.any({1, 2, 5}), walls = random.any({6, 40});
  const double slope = between(random, 0, 0.6);
  for (int z = 0; z < volume.grid.z; ++z)
    for (int x = 0; x < volume.grid.x; ++x) {
      const auto column = static_cast<std::size_t>(z * volume.grid.x + x);
      const bool given = terrain.height.size() > column;
      const double height = given ? terrain.height[column] : 1 + slope * x + random.below(rough);
      const int bed = std::clamp(static_cast<int>(std::lround(height)), 0, volume.grid.y);
      const int liquid = random.one_in(film) ? 0 : random.between(1, 2 + x % 3);
      const bool wall = random.one_in(walls);
      for (int y = 0; y < volume.grid.y; ++y) {
        const bool hangs = y > bed + 3 && (x / 4 + y / 3 + z / 4) % 5 == 0;
        put(volume, x, y, z,
            y < bed || (wall && y < bed + 4) ? kInert
            : y < bed + liquid && bed > 0    ? kLiquid
            : hangs                          ? kSolid
                                             : kAir,
            random);
      }
    }
}

void fill(state::Volume& volume, const scene::Terrain& terrain, Random& random) {
  const int kind = random.below(10);
  if (kind == 0) return;
  if (kind <= 2) {  // full
    const int number = random.any({kSolid, kLiquid, kInert});
    worlds::for_each(worlds::whole(volume.grid),
                     [&](int x, int y, int z) { put(volume, x, y, z, number, random); });
    if (kind == 2) return;
    worlds::for_each(worlds::whole(volume.grid),
                     [&](int x, int y, int z) { volume.amount[volume.at(x, y, z)] = 4096; });
    return;
  }
  if (kind <= 5) return fill_lumps(volume, random);
  fill_land(volume, terrain, random);
}

scene::Terrain hostile_terrain(Random& random, const state::Grid& grid) {
  scene::Terrain terrain;
  if (random.one_in(2)) return terrain;
  terrain.x = grid.x;
  terrain.z = grid.z;
  terrain.textured = random.one_in(2);
  const int kind = random.below(4);
  const double high = between(random, 0, 1.2 * grid.y), hill = between(random, 2, 9);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x)
      terrain.height.push_back(
          static_cast<float>(kind == 0   ? high
                             : kind == 1 ? between(random, -1, high)
                             : kind == 2 ? 0.5 * high * (1 + std::sin(x / hill) * std::cos(z / hill))
                                         : (x / 5 + z / 5) % 2 * high));
  if (random.one_in(8)) {
    ++terrain.x;  // another number of columns
    terrain.height.resize(static_cast<std::size_t>(terrain.x) * static_cast<std::size_t>(terrain.z), 2.5f);
  }
  return terrain;
}

scene::Look hostile_look(Random& random) {
  scene::Look look;
  for (scene::Vec3* color : {&look.solid, &look.liquid, &look.ground, &look.background})
    for (double& channel : *color) channel = edged(random);
  look.shininess = random.any({1.0, 40.0, 12.0, 3.5, 255.0, 256.5, 10000.0, 7.49});
  look.specular = edged(random);
  look.metallic = edged(random);
  look.glow = random.one_in(2);
  look.glow_cold = edged(random) * 0.6;
  look.glow_hot = look.glow_cold + (random.one_in(5) ? 0x1p-16 : fraction(random) * 0.4);
  // Clear looks go from a fog to a glass, with colours. If the look glows, they have no colour.
  if (random.one_in(2)) {
    const bool glow = look.glow && random.one_in(4);
    look.glow = glow;
    for (double& half : look.clear)
      half = random.any({0.0, 0.01, kBelowHalfClear, 0x1p-7, 1.0, 256.0, 3.3, between(random, 0, 40)});
    if (random.one_in(6))
      look.clear = random.any<scene::Vec3>({{kBelowHalfClear, 0, 0}, {0, 0x1p-7, 0}, {0, 0, 9}});
    look.frost = random.one_in(3) ? 0.2 * edged(random) : edged(random);
  }
  look.smooth = random.below(7);
  look.smooth_solid = random.below(7);
  return look;
}

// The light comes along axes, along diagonals and from below. It has any length.
scene::Light hostile_light(Random& random) {
  scene::Light light;
  const auto component = [&] {
    return random.one_in(2) ? random.any({-1.0, 0.0, 1.0}) : between(random, -1, 1);
  };
  do light.direction = {component(), component(), component()};
  while (light.direction == scene::Vec3{0, 0, 0});
  const double length = random.any({1.0, 1.0, 1e-7, 1e6, 0.3, 0x1p-40});
  for (double& c : light.direction) c *= length;
  light.ambient = edged(random);
  return light;
}

scene::Camera hostile_camera(Random& random, const state::Volume& volume) {
  scene::Camera camera;
  const int size[3] = {volume.grid.x, volume.grid.y, volume.grid.z};
  const int at = random.below(6);
  for (std::size_t i = 0; i < 3; ++i) {
    const double any = between(random, 0, size[i]);
    camera.target[i] = at == 0   ? std::floor(any)        // on faces of cells
                       : at == 1 ? std::floor(any) + 0.5  // in the middle of a cell
                       : at == 2 ? any
                       : at == 3 ? between(random, -3, size[i] + 3)
                                 : size[i] * 0.5;
  }
  if (random.one_in(30)) camera.target = {65535, -60000.25, between(random, -65000, 65000)};
  camera.azimuth = random.one_in(2) ? random.any({0.0, 90.0, -90.0, 180.0, 270.0, 360.0, -360.0, 45.0, 1e-5})
                                    : between(random, -360, 360);
  camera.elevation = random.one_in(3)   ? random.any({0.0, 89.0, -89.0, 90.0, -90.0, 45.0, -1e-5})
                     : random.one_in(4) ? between(random, -89, 0)
                                        : between(random, -10, 89);
  const double far = size[0] + size[1] + size[2];
  const int distance = random.below(10);
  camera.distance = distance < 4 ? 0
                    : distance == 4
                        ? random.any({0x1p-12, 1e-4, 1e-5, 0.25, 1.0})  // in the matter or air of the target
                    : distance == 5 ? random.any({0x1p18, 200000.5, 5000.0})
                    : distance < 8  ? between(random, 0, far / 4)
                                    : between(random, 0, 2 * far);
  camera.field_of_view =
      random.one_in(2) ? random.any({1.0, 150.0, 30.0, 90.0, 120.0, 2.5}) : between(random, 1, 150);
  struct Size {
    int width, height;
  };
  const Size pixels = random.any<Size>(
      {{1, 1}, {17, 33}, {96, 72}, {64, 64}, {80, 60}, {97, 5}, {3, 70}, {64, 1}, {1, 40}, {128, 64}});
  camera.width = pixels.width;
  camera.height = pixels.height;
  if (random.one_in(100)) {
    camera.width = 8192;
    camera.height = random.any({8, 16});
  }
  if (random.one_in(4)) {  // pixels of the sizes at which rays take finer steps (picture::halvings_of)
    const double near = between(random, 0.5, 1.5) * far, pixel = between(random, 0.03, 0.13);
    camera.distance = near + far / 4;
    const double half = std::atan(pixel * camera.height / 2 / near) * 180 / std::numbers::pi;
    camera.field_of_view = std::clamp(2 * half, 1.0, 150.0);
  }
  return camera;
}

}  // namespace

HostilePicture hostile_picture(std::uint64_t seed, int most) {
  Random random(seed * 7919 + 15);
  HostilePicture picture;
  picture.volume = state::Volume(hostile_grid(random, most));
  picture.terrain = hostile_terrain(random, picture.volume.grid);
  fill(picture.volume, picture.terrain, random);
  picture.look = hostile_look(random);
  picture.light = hostile_light(random);
  picture.camera = hostile_camera(random, picture.volume);
  picture.setting = random.any({render::Setting::fast, render::Setting::normal, render::Setting::best});
  if (random.one_in(2)) any_materials(picture.look, random);
  of_any_materials(picture.volume, picture.look, random);
  return picture;
}

HostilePicture hostile_clear_picture(std::uint64_t seed, int most) {
  Random random(seed * 6151 + 3);
  HostilePicture picture = hostile_picture(random.bits(), most);
  state::Volume& volume = picture.volume;
  volume = state::Volume(state::Grid{random.between(5, 20), random.between(5, 20), random.between(5, 20)});
  picture.terrain = hostile_terrain(random, volume.grid);
  switch (random.below(3)) {
    case 0:
      fill_land(volume, picture.terrain, random);
      break;
    case 1:
      fill_lumps(volume, random);
      break;
    default:  // a block from side to side with obstacles and holes in it, perhaps on ground
      const int holes = random.any({30, 200}), walls = random.any({20, 300}), bed = random.below(3);
      worlds::for_each(worlds::whole(volume.grid), [&](int x, int y, int z) {
        put(volume, x, y, z,
            y < bed || random.one_in(walls) ? kInert
            : random.one_in(holes)          ? kAir
            : (x + z) % 9 < 4               ? kLiquid
                                            : kSolid,
            random);
        if (random.below(8) > 0 && y >= bed && volume.amount[volume.at(x, y, z)] > 0)
          volume.amount[volume.at(x, y, z)] = 4096;
      });
  }
  picture.look.glow = false;
  for (double& half : picture.look.clear) half = random.any({2.0, 256.0, 0.3, between(random, 1, 40)});
  picture.look.frost = random.one_in(4) ? edged(random) : 0.1 * fraction(random);
  picture.light.ambient = 0.5;
  picture.camera = hostile_camera(random, volume);
  picture.camera.width = random.between(20, 48);
  picture.camera.height = random.between(20, 48);
  if (!random.one_in(4))
    picture.camera.target = {0.5 * volume.grid.x, 0.5 * volume.grid.y, 0.5 * volume.grid.z};
  of_any_materials(volume, picture.look, random);
  return picture;
}

HostilePicture hostile_orthographic_picture(std::uint64_t seed, int most) {
  HostilePicture picture = hostile_picture(seed, most);
  Random random(seed * 104729 + 3);
  scene::Camera& camera = picture.camera;
  camera.orthographic = true;
  if (random.one_in(4)) return picture;
  const state::Grid& grid = picture.volume.grid;
  camera.target = {0.5 * grid.x, 0.5 * grid.y, 0.5 * grid.z};
  const double pixel = between(random, 0.02, 0.3), half = camera.field_of_view / 2;
  camera.distance =
      random.one_in(3) ? 0 : pixel * camera.height / 2 / std::tan(half * std::numbers::pi / 180);
  return picture;
}

std::string description(const HostilePicture& picture) {
  const state::Grid& grid = picture.volume.grid;
  const scene::Camera& camera = picture.camera;
  std::ostringstream text;
  text.precision(17);
  text << "grid " << grid.x << ' ' << grid.y << ' ' << grid.z << ", smooth " << picture.look.smooth << ' '
       << picture.look.smooth_solid << (picture.look.glow ? ", glow" : "")
       << (picture.look.clear != scene::Vec3{} ? ", clear" : "")
       << (picture.volume.material.empty() ? "" : ", materials")
       << (picture.terrain.height.empty() ? ""
           : picture.terrain.textured     ? ", textured terrain"
                                          : ", terrain")
       << ", light";
  for (const double a : picture.light.direction) text << ' ' << a;
  text << ", camera";
  for (const double a : {camera.target[0], camera.target[1], camera.target[2], camera.azimuth,
                         camera.elevation, camera.distance, camera.field_of_view})
    text << ' ' << a;
  text << ", " << camera.width << " x " << camera.height << (camera.orthographic ? ", parallel" : "")
       << ", setting " << static_cast<int>(picture.setting);
  return text.str();
}

}  // namespace voxmelt::test
