// Places of the picture become pressed light, one packet after the other.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "render/packet/clear_packet.h"
#include "render/packet/ground_packet.h"
#include "render/packet/shade_packet.h"
#include "render/rule/nearer.h"

namespace voxmelt::render {

template <class Arch>
struct DrawPacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using Field = FieldPacket<Arch>;
  using Ground = GroundPacket<Arch>;
  using Shade = ShadePacket<Arch>;
  using Clear = ClearPacket<Arch>;
  using Color = typename Shade::Color;

  // Holds what a packet meets. `matter` and `ground` are masks, and no lane is set in both.
  struct Met {
    V matter, ground;
    V from_start;  // the eye is in matter or ground
    V face;        // face of the ground
    Triple position;
  };

  // Holds a packet's rays, and the ground that they meet.
  struct Approach {
    typename Rays<Arch>::Row row;
    Triple start;
    typename Ground::Hits ground;
    V most;  // last sample that counts, as matter behind the ground does not
    typename Field::Hits hits;
  };
  VOXMELT_WORDS void approach(const PictureData& data, V across, V down, Approach& the_approach) {
    the_approach.row = Rays<Arch>::through(data, across, down);
    the_approach.start = Rays<Arch>::wrapped_start(the_approach.row);
    the_approach.ground = {V{}, V{}, V{}};
    if (data.ground.any && data.ground.flat)
      the_approach.ground = Ground::march(data, the_approach.row, the_approach.start);
    the_approach.most = last_sample(the_approach);
  }
  VOXMELT_WORDS V last_sample(const Approach& approach) {
    return approach.ground.found ? (approach.ground.inside >> picture::kPartBits) + 1 : L::set(INT32_MAX);
  }
  // Marches two packets at once, because hills take many looks. It is out of line, because flat scenes are
  // faster so.
  [[gnu::noinline]] static void march_hills(const PictureData& data, Approach* approach, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 2) {
      Approach &one = approach[i], &other = approach[std::min(i + 1, count - 1)];
      Ground::march(data, one, other);
      one.most = last_sample(one);
      other.most = last_sample(other);
    }
  }

  [[gnu::always_inline]] static inline Met met(const PictureData& data, const Approach& from) {
    Met result{V{}, V{}, V{}, V{}, Triple{V{}, V{}, V{}}};
    const auto& row = from.row;
    const auto& start = from.start;
    const auto& hits = from.hits;
    auto ground = from.ground;
    Triple outside{V{}, V{}, V{}};
    if (L::any(ground.found)) {
      Ground::bisect(data.ground, row, start, ground);
      result.ground = ground.found;
      result.position = Rays<Arch>::at_part(row, start, ground.inside);
      outside = Rays<Arch>::at_part(row, start, ground.before);
      result.face = Ground::face_of(data.ground, ground.found, ground.inside, outside);
      result.from_start = ground.inside == 0;
    }
    if (L::any(hits.found)) {
      const auto surface = Field::crossing(data.field, row, hits);
      // Places count from the sample before matter, as in rule/nearer.h.
      const V samples = L::clamp((ground.inside >> picture::kPartBits) - (hits.sample - 1), -8, 8);
      const V place = samples * picture::kPlaces +
                      (ground.inside & (picture::kParts - 1)) * (picture::kPlaces / picture::kParts);
      const V first = result.face == static_cast<std::int32_t>(picture::Face::top)
                          ? V{}
                          : L::set(static_cast<std::int32_t>(picture::kSideFirst << data.view.halvings));
      result.ground = result.ground & (~hits.found | (place <= surface.part + first));
      result.matter = hits.found & ~result.ground;
      constexpr std::int32_t kBack = -Field::kBias;
      result.position = P::select(
          result.matter, surface.at + Triple{L::set(kBack), L::set(kBack), L::set(kBack)}, result.position);
      result.from_start = result.matter ? hits.sample == 0 : result.from_start;
    }
    return result;
  }

  // Holds the surfaces of a packet. For lanes that meet nothing, positions are 0 and normals any unit
  // vectors.
  struct Surface {
    Met met{};
    V found{};
    Triple to_eye{}, position{}, lattice{}, normal{};
    typename Ground::Painted paint{};
  };

  // Finds the surfaces, and tells whether there is any.
  [[gnu::always_inline]] static inline bool surface(const PictureData& data, const Approach& from,
                                                    Surface& the_surface) {
    const auto& row = from.row;
    the_surface.met = met(data, from);
    the_surface.found = the_surface.met.matter | the_surface.met.ground;
    if (!L::any(the_surface.found)) return false;
    the_surface.to_eye = P::unit_of(Triple{} - row.step, data.inverse_root);
    the_surface.position = P::select(the_surface.found, the_surface.met.position, Triple{});
    the_surface.normal = the_surface.to_eye;
    if (L::any(the_surface.met.ground)) {
      the_surface.paint = Ground::painted(data, the_surface.met.ground, the_surface.met.face,
                                          the_surface.position, the_surface.to_eye);
      the_surface.normal = P::select(the_surface.met.ground, the_surface.paint.normal, the_surface.normal);
    }
    if (L::any(the_surface.met.matter)) {
      constexpr std::int32_t kBias = Field::kBias;
      the_surface.lattice =
          P::select(the_surface.met.matter,
                    the_surface.position + Triple{L::set(kBias), L::set(kBias), L::set(kBias)}, Triple{});
      the_surface.normal = P::select(the_surface.met.matter & ~the_surface.met.from_start,
                                     Field::normal(data, the_surface.lattice), the_surface.normal);
    }
    return true;
  }

  [[gnu::always_inline]] static inline Color light(const PictureData& data, const Approach& from) {
    Color color{{L::set(data.background[0]), L::set(data.background[1]), L::set(data.background[2])}};
    Surface the_surface;
    if (!surface(data, from, the_surface)) return color;
    const auto arriving = LightPacket<Arch>::at(
        data.light, data.paint->glow,
        LightPacket<Arch>::before(the_surface.position, the_surface.normal, data.light.shift));
    Color lit = color;
    if (L::any(the_surface.met.ground)) {
      const Color own{{the_surface.paint.color[0], the_surface.paint.color[1], the_surface.paint.color[2]}};
      lit = Shade::select(the_surface.met.ground,
                          Shade::ground_color(*data.paint, the_surface.normal, arriving, own), lit);
    }
    if (L::any(the_surface.met.matter)) {
      const V matter = Field::matter(data.field, the_surface.lattice);
      const Triple out =
          P::select(the_surface.met.matter, the_surface.lattice + (the_surface.normal << 5), Triple{});
      const V outside = data.field.obstacles ? Field::matter(data.field, out) : V{};
      lit = Shade::select(the_surface.met.matter,
                          Shade::matter_color(data, the_surface.normal, the_surface.to_eye, arriving, matter,
                                              (outside >> 16) & 255),
                          lit);
    }
    return Shade::select(the_surface.found, Shade::pressed(*data.tone, lit), color);
  }

  // Computes the light through clear matter. A ray may see matter, ground and background at once.
  [[gnu::noinline]] static void clear_light(const PictureData& data, V across, V down, Color& to) {
    const auto row = Rays<Arch>::through(data, across, down);
    const Triple start = Rays<Arch>::wrapped_start(row),
                 to_eye = P::unit_of(Triple{} - row.step, data.inverse_root);
    typename Ground::Hits ground{V{}, V{}, V{}};
    if (data.ground.any) ground = Ground::march(data, row, start);
    V face{};
    if (L::any(ground.found)) {
      Ground::bisect(data.ground, row, start, ground);
      face = Ground::face_of(data.ground, ground.found, ground.inside,
                             Rays<Arch>::at_part(row, start, ground.before));
    }
    const V first = face == static_cast<std::int32_t>(picture::Face::top)
                        ? V{}
                        : L::set(static_cast<std::int32_t>(picture::kSideFirst << data.view.halvings));
    typename Clear::Rest rest{
        data, row,     to_eye, P::dot((Triple{} - row.step) >> 4, to_eye) >> 14, L::set(picture::kLight),
        V{},  Color{}, Color{}};
    const V arrived = Clear::follow(rest, {ground.found, ground.inside, first});
    const Color share = rest.passed();
    Color behind{};
    if (L::any(arrived)) {
      const Triple position = P::select(arrived, Rays<Arch>::at_part(row, start, ground.inside), Triple{});
      const auto paint = Ground::painted(data, arrived, face, position, to_eye);
      const Triple normal = P::select(arrived, paint.normal, to_eye);
      const auto light = LightPacket<Arch>::at(data.light, false,
                                               LightPacket<Arch>::before(position, normal, data.light.shift));
      const Color own{{paint.color[0], paint.color[1], paint.color[2]}};
      behind = Shade::select(arrived, Shade::ground_color(*data.paint, normal, light, own), behind);
    }
    Color sum;
    for (std::size_t c = 0; c < 3; ++c)
      sum.c[c] =
          rest.mirrored.c[c] + ((rest.scattered.c[c] + share.c[c] * behind.c[c]) >> picture::kPassedBits);
    to = Shade::pressed(*data.tone, sum);
    for (std::size_t c = 0; c < 3; ++c) {
      const V through = L::min(to.c[c] + ((share.c[c] * data.background[c]) >> picture::kPassedBits),
                               L::set(picture::kLight));
      to.c[c] = arrived ? to.c[c] : through;
    }
  }

  // Draws all places, rounded up to whole packets (see Places).
  static void draw(const PictureData& data, Places places, PressedLight to) {
    const auto store = [&](const Color& color, std::size_t i) {
      L::store_halves(color.c[0], to.red + i);
      L::store_halves(color.c[1], to.green + i);
      L::store_halves(color.c[2], to.blue + i);
    };
    if (data.paint->clear) {
      for (std::size_t i = 0; i < places.count; i += P::kCount) {
        Color color;
        clear_light(data, L::load(places.across + i), L::load(places.down + i), color);
        store(color, i);
      }
      return;
    }
    constexpr std::size_t kBatch = 16;
    Approach the_approach[kBatch];
    for (std::size_t i = 0; i < places.count;) {
      const std::size_t first = i;
      std::size_t count = 0;
      for (; count < kBatch && i < places.count; ++count, i += P::kCount)
        approach(data, L::load(places.across + i), L::load(places.down + i), the_approach[count]);
      if (data.ground.any && !data.ground.flat) march_hills(data, the_approach, count);
      Field::march(data, the_approach, the_approach + count);
      for (std::size_t j = 0; j < count; ++j) store(light(data, the_approach[j]), first + j * P::kCount);
    }
  }

  static void find(const PictureData& data, Places places, FoundSurface to) {
    const auto store = [](V vector, std::int32_t* at) { std::memcpy(at, &vector, sizeof vector); };
    for (std::size_t i = 0; i < places.count; i += P::kCount) {
      Surface the_surface;
      Approach from;
      approach(data, L::load(places.across + i), L::load(places.down + i), from);
      if (data.ground.any && !data.ground.flat) march_hills(data, &from, 1);
      from.hits = Field::march(data, from.row, from.most);
      if (!surface(data, from, the_surface)) {
        store(V{}, to.found + i);
        continue;
      }
      store(the_surface.found, to.found + i);
      const V position[3] = {the_surface.position.x, the_surface.position.y, the_surface.position.z};
      const V normal[3] = {the_surface.normal.x, the_surface.normal.y, the_surface.normal.z};
      for (std::size_t j = 0; j < 3; ++j) {
        store(position[j], to.position[j] + i);
        store(normal[j], to.normal[j] + i);
      }
    }
  }
};

template <class Arch>
Packets packets_for() {
  return {&DrawPacket<Arch>::draw, &DrawPacket<Arch>::find, Packet<Arch>::kCount};
}

}  // namespace voxmelt::render
