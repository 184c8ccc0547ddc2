#include "render/raycast/noise.h"

#include <cmath>
#include <cstdint>

namespace voxmelt::render {
namespace {

float lattice(int x, int y, int z) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x8da6b343u ^
                    static_cast<std::uint32_t>(y) * 0xd8163841u ^ static_cast<std::uint32_t>(z) * 0xcb1ab31fu;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  h ^= h >> 15;
  return static_cast<float>(h >> 8) * (2.0f / 16777215.0f) - 1;
}

float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

}  // namespace

float noise(Vec point) {
  const float bx = std::floor(point.x), by = std::floor(point.y), bz = std::floor(point.z);
  const int x = static_cast<int>(bx), y = static_cast<int>(by), z = static_cast<int>(bz);
  const float tx = fade(point.x - bx), ty = fade(point.y - by), tz = fade(point.z - bz);
  const auto along_x = [&](int dy, int dz) {
    return mix(lattice(x, y + dy, z + dz), lattice(x + 1, y + dy, z + dz), tx);
  };
  return mix(mix(along_x(0, 0), along_x(1, 0), ty), mix(along_x(0, 1), along_x(1, 1), ty), tz);
}

float layered_noise(Vec point, int octaves) {
  float sum = 0, strength = 0.55f;
  for (int i = 0; i < octaves; ++i, strength *= 0.5f) {
    sum += strength * noise(point);
    point =
        Vec{point.z, point.x, point.y} * 2.03f + Vec{17.1f, 5.7f, 31.3f};  // turned, or the lattices line up
  }
  return sum;
}

}  // namespace voxmelt::render
