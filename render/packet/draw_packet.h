// Places of the picture to pressed light, one packet after the other.
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

  // What a packet meets, of which `matter` and `ground` tell: no lane has both.
  struct Met {
    V matter, ground;
    V from_start;  // the eye is in it
    V face;        // of the ground
    Triple position;
  };

  // A packet's rays, and the ground that they meet.
  struct Approach {
    typename Rays<Arch>::Row row;
    Triple start;
    typename Ground::Hits ground;
    V most;  // the last sample that counts: matter behind the ground does not
    typename Field::Hits hits;
  };
  VOXMELT_WORDS void approach(const PictureData& data, V across, V down, Approach& of) {
    of.row = Rays<Arch>::through(data, across, down);
    of.start = Rays<Arch>::wrapped_start(of.row);
    of.ground = {V{}, V{}, V{}};
    if (data.ground.any && data.ground.flat) of.ground = Ground::march(data, of.row, of.start);
    of.most = last_sample(of);
  }
  VOXMELT_WORDS V last_sample(const Approach& of) {
    return of.ground.found ? (of.ground.inside >> picture::kPartBits) + 1 : L::set(INT32_MAX);
  }
  // On hills it takes many looks: two packets at once. Out of line, because flat scenes are faster so.
  [[gnu::noinline]] static void march_hills(const PictureData& data, Approach* of, std::size_t count) {
    for (std::size_t i = 0; i < count; i += 2) {
      Approach &one = of[i], &other = of[std::min(i + 1, count - 1)];
      Ground::march(data, one, other);
      one.most = last_sample(one);
      other.most = last_sample(other);
    }
  }

  [[gnu::always_inline]] static inline Met met(const PictureData& data, const Approach& from) {
    Met of{V{}, V{}, V{}, V{}, Triple{V{}, V{}, V{}}};
    const auto& row = from.row;
    const auto& start = from.start;
    const auto& hits = from.hits;
    auto ground = from.ground;
    Triple outside{V{}, V{}, V{}};
    if (L::any(ground.found)) {
      Ground::bisect(data.ground, row, start, ground);
      of.ground = ground.found;
      of.position = Rays<Arch>::at_part(row, start, ground.inside);
      outside = Rays<Arch>::at_part(row, start, ground.before);
      of.face = Ground::face_of(data.ground, ground.found, ground.inside, outside);
      of.from_start = ground.inside == 0;
    }
    if (L::any(hits.found)) {
      const auto surface = Field::crossing(data.field, row, hits);
      // rule/nearer.h, in places from the sample before matter.
      const V samples = L::clamp((ground.inside >> picture::kPartBits) - (hits.sample - 1), -8, 8);
      const V place = samples * picture::kPlaces +
                      (ground.inside & (picture::kParts - 1)) * (picture::kPlaces / picture::kParts);
      const V first = of.face == static_cast<std::int32_t>(picture::Face::top)
                          ? V{}
                          : L::set(static_cast<std::int32_t>(picture::kSideFirst << data.view.halvings));
      of.ground = of.ground & (~hits.found | (place <= surface.part + first));
      of.matter = hits.found & ~of.ground;
      constexpr std::int32_t kBack = -Field::kBias;
      of.position =
          P::select(of.matter, surface.at + Triple{L::set(kBack), L::set(kBack), L::set(kBack)}, of.position);
      of.from_start = of.matter ? hits.sample == 0 : of.from_start;
    }
    return of;
  }

  // Positions of lanes that meet nothing are 0, and their normals any unit vectors.
  struct Surface {
    Met met{};
    V found{};
    Triple to_eye{}, position{}, lattice{}, normal{};
    typename Ground::Painted paint{};
  };

  // Tells whether there is any.
  [[gnu::always_inline]] static inline bool surface(const PictureData& data, const Approach& from,
                                                    Surface& of) {
    const auto& row = from.row;
    of.met = met(data, from);
    of.found = of.met.matter | of.met.ground;
    if (!L::any(of.found)) return false;
    of.to_eye = P::unit_of(Triple{} - row.step, data.inverse_root);
    of.position = P::select(of.found, of.met.position, Triple{});
    of.normal = of.to_eye;
    if (L::any(of.met.ground)) {
      of.paint = Ground::painted(data, of.met.ground, of.met.face, of.position, of.to_eye);
      of.normal = P::select(of.met.ground, of.paint.normal, of.normal);
    }
    if (L::any(of.met.matter)) {
      constexpr std::int32_t kBias = Field::kBias;
      of.lattice = P::select(of.met.matter, of.position + Triple{L::set(kBias), L::set(kBias), L::set(kBias)},
                             Triple{});
      of.normal = P::select(of.met.matter & ~of.met.from_start, Field::normal(data, of.lattice), of.normal);
    }
    return true;
  }

  [[gnu::always_inline]] static inline Color light(const PictureData& data, const Approach& from) {
    Color color{{L::set(data.background[0]), L::set(data.background[1]), L::set(data.background[2])}};
    Surface of;
    if (!surface(data, from, of)) return color;
    const auto arriving = LightPacket<Arch>::at(
        data.light, data.paint->glow, LightPacket<Arch>::before(of.position, of.normal, data.light.shift));
    Color lit = color;
    if (L::any(of.met.ground)) {
      const Color own{{of.paint.color[0], of.paint.color[1], of.paint.color[2]}};
      lit = Shade::select(of.met.ground, Shade::ground_color(*data.paint, of.normal, arriving, own), lit);
    }
    if (L::any(of.met.matter)) {
      const V matter = Field::matter(data.field, of.lattice);
      const Triple out = P::select(of.met.matter, of.lattice + (of.normal << 5), Triple{});
      const V outside = data.field.obstacles ? Field::matter(data.field, out) : V{};
      lit = Shade::select(
          of.met.matter,
          Shade::matter_color(data, of.normal, of.to_eye, arriving, matter, (outside >> 16) & 255), lit);
    }
    return Shade::select(of.found, Shade::pressed(*data.tone, lit), color);
  }

  // The light through clear matter: matter, ground and background may all be seen by a ray.
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

  // Places are rounded up to whole packets: see Places.
  static void draw(const PictureData& data, Places places, PressedLight to) {
    const auto store = [&](const Color& of, std::size_t i) {
      L::store_halves(of.c[0], to.red + i);
      L::store_halves(of.c[1], to.green + i);
      L::store_halves(of.c[2], to.blue + i);
    };
    if (data.paint->clear) {
      for (std::size_t i = 0; i < places.count; i += P::kCount) {
        Color of;
        clear_light(data, L::load(places.across + i), L::load(places.down + i), of);
        store(of, i);
      }
      return;
    }
    constexpr std::size_t kBatch = 16;
    Approach of[kBatch];
    for (std::size_t i = 0; i < places.count;) {
      const std::size_t first = i;
      std::size_t count = 0;
      for (; count < kBatch && i < places.count; ++count, i += P::kCount)
        approach(data, L::load(places.across + i), L::load(places.down + i), of[count]);
      if (data.ground.any && !data.ground.flat) march_hills(data, of, count);
      Field::march(data, of, of + count);
      for (std::size_t j = 0; j < count; ++j) store(light(data, of[j]), first + j * P::kCount);
    }
  }

  static void find(const PictureData& data, Places places, FoundSurface to) {
    const auto store = [](V of, std::int32_t* at) { std::memcpy(at, &of, sizeof of); };
    for (std::size_t i = 0; i < places.count; i += P::kCount) {
      Surface of;
      Approach from;
      approach(data, L::load(places.across + i), L::load(places.down + i), from);
      if (data.ground.any && !data.ground.flat) march_hills(data, &from, 1);
      from.hits = Field::march(data, from.row, from.most);
      if (!surface(data, from, of)) {
        store(V{}, to.found + i);
        continue;
      }
      store(of.found, to.found + i);
      const V position[3] = {of.position.x, of.position.y, of.position.z};
      const V normal[3] = {of.normal.x, of.normal.y, of.normal.z};
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
