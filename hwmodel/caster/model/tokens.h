// The channels of a pipe carry these tokens.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/clear.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/ray.h"
#include "hwmodel/caster/model/ray_id.h"
#include "hwmodel/caster/model/shade.h"

namespace voxmelt::hwmodel::raycast {

// Names a tile of the picture that a pipe is to draw. The first pass draws all of its pixels with one sample.
// The second one draws those that differ from their neighbours, with more samples.
struct TileJob {
  std::int32_t x = 0, y = 0;  // first pixel
  bool second = false;
};
// Adds a buffer to a tile, and the pixels that are to be drawn: bit 8 y + x.
struct TileOrder {
  std::int32_t x = 0, y = 0;
  std::int32_t buffer = 0, samples = 1;
  std::uint64_t pixels = 0;
};

// Holds the place of a sample in a pixel, in 64ths (docs/picture/definition.md, section 10).
struct Sub {
  std::int64_t across = 32, down = 32;
};
inline Sub sub_of(int samples, int which) {
  constexpr std::array<std::uint8_t, 8> kEight{3, 6, 0, 5, 2, 7, 1, 4};
  constexpr std::array<std::uint8_t, 32> kMany{2,  15, 24, 28, 12, 4,  20, 16, 7,  22, 31, 1, 8,  14, 27, 11,
                                               19, 25, 30, 5,  21, 10, 3,  26, 17, 0,  13, 6, 23, 9,  29, 18};
  if (samples == 1) return {};
  const std::int64_t unit = 64 / samples, i = which;
  const std::int64_t row = samples == 8 ? kEight[which] : kMany[which];
  return {unit * i + unit / 2, unit * row + unit / 2};
}

struct RayToken {
  RayId id;
  Ray ray;
};
struct GroundedRay {
  RayId id;
  Ray ray;
  GroundHit ground;
};
struct MetToken {
  RayId id;
  Ray ray;
  GroundHit ground;
  Crossing matter;
  // A ray that goes on through clear matter has these. They tell its place in the walk, how often it has
  // entered matter before, whether it leaves it here, and the sample in matter.
  std::int32_t context = 0;
  std::int16_t span = 0;
  bool leaves = false;
  std::int16_t level = 0;
  Vec at{};
};
// Returns such a ray to the walk: it has left matter, and sample k is known to be air.
struct OnwardToken {
  std::int32_t context = 0;
  std::int64_t k = 0;
  Vec at;
  std::int16_t level = 0;
};

// Names the stage that wants levels.
enum class Asker : std::uint8_t { walk, crossing, normal, stretch };
struct LevelRequest {
  Asker asker = Asker::walk;
  std::int32_t context = 0;  // number of the ray under way
  RayId id;
  std::int64_t k = 0;  // number of the sample in the walk
  Vec at;              // in the lattice

  std::size_t kind_index() const { return asker == Asker::normal ? 1 : 0; }
  Places places() const {
    Places result;
    const auto place = [](std::int64_t q) { return static_cast<std::int32_t>(q >> kCellBits); };
    result.low = {place(at.x), place(at.y), place(at.z)};
    if (asker == Asker::normal) {
      result.side = result.high = 3;
      const auto three = [](std::int64_t q) {
        const auto middle = static_cast<std::int32_t>(middle_place(q));
        return std::array<std::int32_t, 4>{middle - 1, middle, middle + 1, 0};
      };
      result.x = three(at.x);
      result.y = three(at.y);
      result.z = three(at.z);
    } else {
      result.x = {result.low[0], result.low[0] + 1, 0, 0};
      result.y = {result.low[1], result.low[1] + 1, 0, 0};
      result.z = {result.low[2], result.low[2] + 1, 0, 0};
    }
    return result;
  }
};
using LevelGather = Gather<LevelRequest, std::int16_t, 27>;
using Levels = LevelGather::Out;

// Answers a request with a sample.
struct LevelToken {
  LevelRequest request;
  std::int16_t level = 0;
};

// Asks for the bytes of matter around a position.
struct MatterRequest {
  Spots at;
  RayId id;
  std::size_t kind_index() const { return 0; }
  Places places() const {
    const auto two = [](const Spot& s) {
      const auto low = static_cast<std::int32_t>(s.cell + kLatticeBorder);
      return std::array<std::int32_t, 4>{low, low + 1, 0, 0};
    };
    Places result{two(at.x), two(at.y), two(at.z), 2, {}};
    result.low = {result.x[0], result.y[0], result.z[0]};
    return result;
  }
};
using MatterGather = Gather<MatterRequest, std::uint32_t, 8>;

// Asks for cells of light, or columns, or texels. Those beyond the edge are the nearest inside.
struct ClampedRequest {
  Spots at;
  std::array<std::int32_t, 3> count{1, 1, 1};
  std::int32_t asker = 0, context = 0;
  int side = 2;
  RayId id;

  std::size_t kind_index() const { return asker; }
  Places places() const {
    const auto along = [](const Spot& s, std::int32_t n) {
      const auto inside = [&](std::int64_t i) {
        return static_cast<std::int32_t>(i < 0 ? 0 : i >= n ? n - 1 : i);
      };
      return std::array<std::int32_t, 4>{inside(s.cell), inside(s.cell + 1), inside(s.cell + 2),
                                         inside(s.cell + 3)};
    };
    return {along(at.x, count[0]), along(at.y, count[1]), along(at.z, count[2]), side, {},
            side == 4 ? 1 : side};
  }
};
using LightGather = Gather<ClampedRequest, LightWord, 8>;
using ColumnGather = Gather<ClampedRequest, Column, 16>;
using TexelGather = Gather<ClampedRequest, Texel, 8>;

// Tells of an event on a ray through clear matter which of the rays under way it is on, and its number there.
struct ClearEvent {
  std::int32_t context = 0;
  bool leaves = false;  // the ray leaves matter here
  std::int32_t event = 0;
  std::int32_t way = 0;
  Rgb gleam{};
};
// Describes a surface that a ray meets, or the background, on its way to a colour. In clear matter it may be
// a way, too. Each stage adds what it finds.
struct Surface {
  enum class Kind : std::uint8_t { background, matter, ground, way };
  RayId id;
  Kind kind = Kind::background;
  bool inside = false;  // the ray starts in it
  Face face = Face::none;
  Vec position, step;
  std::int64_t depth = 65535;
  Vec to_eye, normal;
  MatterBytes matter;
  Rgb color{};  // colour of the ground
  Light light;
  Mixture mixture;
  Arriving arriving;
  Mirrored mirrored;
  Rgb sum{};
  ClearEvent clear;
};
// Describes a ray through clear matter at its end, and the light behind.
struct PassedToken {
  RayId id;
  bool on_ground = false;
  Passage passage;
  Rgb behind{};
};
struct PressedToken {
  RayId id;
  Rgb pressed{};
};
struct PixelToken {
  RayId id;  // its last sample
  std::array<std::uint8_t, 3> bytes{};
};

}  // namespace voxmelt::hwmodel::raycast
