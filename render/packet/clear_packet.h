// The rays of a packet see through clear matter (rule/clear.h, clear_painter.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/packet/field_packet.h"
#include "render/packet/light_packet.h"
#include "render/packet/shade_packet.h"
#include "render/rule/clear.h"
#include "render/rule/nearer.h"

namespace voxmelt::render {

template <class Arch>
struct ClearPacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using Field = FieldPacket<Arch>;
  using Lights = LightPacket<Arch>;
  using Shade = ShadePacket<Arch>;
  using Color = typename Shade::Color;
  using Row = typename Rays<Arch>::Row;
  static constexpr std::int32_t kBias = Field::kBias;

  // Holds the ground on the rays. Places are in parts of steps, and `first` is the bias of rule/nearer.h.
  struct Ground {
    V found, part, first;
  };

  struct Rest {
    const PictureData& data;
    const Row& row;
    Triple to_eye;
    V step;  // length of a step
    V surfaces, way;
    Color mirrored, scattered;

    [[gnu::always_inline]] Color passed() const {
      const picture::Paint& paint = *data.paint;
      Color color;
      for (std::size_t c = 0; c < 3; ++c) {
        const V i = L::min(((way >> 8) * paint.losses[c]) >> 12, L::set(picture::kNothingPasses));
        color.c[c] = (surfaces * (L::template gather<2>(paint.passing.data(), i) & 0xFFFF)) >> 12;
      }
      return color;
    }
    [[gnu::always_inline]] V dark() const {
      const Color left = passed();
      return (left.c[0] | left.c[1] | left.c[2]) == 0;
    }
    // Returns a / 2^kBits of a step.
    template <int kBits>
    [[gnu::always_inline]] V part(V a) const {
      return (step * a) >> kBits;
    }
    [[gnu::always_inline]] void dim(V rays, V lost) {
      surfaces = rays ? (surfaces * (picture::kLight - lost)) >> 12 : surfaces;
    }
    // Adds the light that the last change of `passed` scatters. Rays whose numbers have not changed add
    // nothing.
    [[gnu::always_inline]] void scatter(const Color& before, const Color& color) {
      const Color after = passed();
      for (std::size_t c = 0; c < 3; ++c)
        scattered.c[c] = scattered.c[c] + (before.c[c] - after.c[c]) * color.c[c];
    }

    // Takes some rays into matter or out of it, at a lattice position.
    [[gnu::always_inline]] void surface(V rays, Triple at, V enters) {
      at = P::select(rays, at, Triple{L::set(kBias), L::set(kBias), L::set(kBias)});
      const Triple out = P::select(rays, Field::normal(data, at), to_eye);
      const Triple position = at - Triple{L::set(kBias), L::set(kBias), L::set(kBias)};
      const auto light = Lights::at(data.light, false, Lights::before(position, out, data.light.shift));
      const V matter = Field::matter(data.field, at);
      const V obstacle =
          data.field.obstacles
              ? (Field::matter(data.field, P::select(rays, at + (out << 5), Triple{})) >> 16) & 255
              : V{};
      const auto shine =
          Shade::shine_of(data, P::select(enters, out, Triple{} - out), out, to_eye, light, matter, obstacle);
      const Color all = passed();
      for (std::size_t c = 0; c < 3; ++c)
        mirrored.c[c] = mirrored.c[c] + (rays & ((all.c[c] * shine.mirrored.c[c]) >> picture::kPassedBits));
      dim(rays, shine.more);
      const Color before = passed();
      const V frost = L::set(data.paint->frost);
      dim(rays, data.field.obstacles ? P::mixed(frost, L::set(picture::kLight), shine.obstacle) : frost);
      scatter(before, shine.scattered);
    }

    // Takes some rays through matter, with the values at a lattice position.
    [[gnu::always_inline]] void walk(V rays, Triple at, V by) {
      at = P::select(rays, at, Triple{L::set(kBias), L::set(kBias), L::set(kBias)});
      const V matter = Field::matter(data.field, at);
      const auto light =
          Lights::at(data.light, false, at - Triple{L::set(kBias), L::set(kBias), L::set(kBias)});
      const Color before = passed();
      way = L::min(way + (rays & by), L::set(picture::kMostWay));
      if (data.field.obstacles) dim(rays, Shade::obstacle_share((matter >> 16) & 255));
      scatter(before, Shade::inner_color(data, light, matter));
    }
  };

  // Holds the state of the rays on their walk. Some look for matter, and others are within it.
  struct Walk {
    V arrived{};  // rays that are at the ground
    V searching = L::set(-1), within{};
    V k{}, level{}, way{};  // last sample, its level, and the way not yet summed up
    Triple at{};            // lattice position of the last sample
    V last;                 // sample before the ground
  };

  // Follows the rays, and tells which of them get to the ground.
  [[gnu::always_inline]] static inline V follow(Rest& rest, const Ground& ground) {
    Walk walk;
    walk.last = ground.found ? ground.part >> picture::kPartBits : L::set(INT32_MAX - 1);
    for (;;) {
      if (L::any(walk.searching)) enter(rest, ground, walk);
      if (!L::any(walk.within)) return walk.arrived;
      go_on(rest, ground, walk);
    }
  }

  // Takes the searching rays to the next matter, to the ground or to nothing.
  [[gnu::always_inline]] static inline void enter(Rest& rest, const Ground& ground, Walk& walk) {
    const PictureData& data = rest.data;
    const Row& row = rest.row;
    const auto hits = Field::march(data, row, walk.searching, walk.k, walk.last + 1);
    walk.arrived = walk.arrived | (walk.searching & ground.found & ~hits.found);
    walk.searching = V{};
    V enters = hits.found;
    if (!L::any(enters)) return;
    const auto surface = Field::crossing(data.field, row, hits);
    const V samples = L::clamp((ground.part >> picture::kPartBits) - (hits.sample - 1), -8, 8);
    const V place = samples * picture::kPlaces +
                    (ground.part & (picture::kParts - 1)) * (picture::kPlaces / picture::kParts);
    const V below = enters & ground.found & (place <= surface.part + ground.first);
    walk.arrived = walk.arrived | below;
    enters = enters & ~below;
    const V crosses = enters & (hits.sample != 0);
    if (L::any(crosses)) rest.surface(crosses, surface.at, crosses);
    enters = enters & ~rest.dark();
    walk.k = enters ? hits.sample : walk.k;
    walk.level = enters ? hits.level : walk.level;
    walk.at = P::select(enters, hits.at, walk.at);
    const V soon = enters & (walk.k > walk.last);
    if (L::any(soon)) rest.walk(soon, walk.at, rest.template part<11>(place - surface.part));
    walk.arrived = walk.arrived | soon;
    enters = enters & ~soon;
    walk.way = enters ? rest.template part<11>(picture::kPlaces - surface.part) : walk.way;
    walk.within = walk.within | enters;
  }

  // Takes the rays within matter along a stretch. It ends where they leave matter or come to the ground.
  [[gnu::always_inline]] static inline void go_on(Rest& rest, const Ground& ground, Walk& walk) {
    const PictureData& data = rest.data;
    const Row& row = rest.row;
    const int stretch = 1 << data.spacing;
    V leaves{}, going = walk.within;
    for (int i = 0; i < stretch; ++i) {
      going = going & (walk.k < walk.last);
      if (!L::any(going)) break;
      const Triple next = P::select(going, walk.at + row.step, Triple{});
      const V here = Field::sample(data.field, next), air = going & (here < 0);
      leaves = leaves | air;
      going = going & ~air;
      walk.k = walk.k - going;
      walk.way = going ? walk.way + rest.step : walk.way;
      walk.level = going ? here : walk.level;
      walk.at = P::select(going, next, walk.at);
    }
    const V ends = walk.within & ~leaves & (walk.k == walk.last);
    walk.way = ends ? walk.way + rest.template part<8>(ground.part & (picture::kParts - 1)) : walk.way;
    Triple exit{};
    if (L::any(leaves)) {
      const auto surface =
          Field::crossing_between(data.field, P::select(leaves, walk.at + row.step, Triple{}),
                                  P::select(leaves, walk.at, Triple{}), walk.level);
      walk.way = leaves ? walk.way + rest.template part<11>(picture::kPlaces - surface.part) : walk.way;
      exit = surface.at;
    }
    rest.walk(walk.within, walk.at, walk.way);
    walk.way = V{};
    if (L::any(leaves)) rest.surface(leaves, exit, V{});
    walk.arrived = walk.arrived | ends;
    walk.within = walk.within & ~ends & ~rest.dark();
    walk.searching = walk.within & leaves;
    walk.within = walk.within & ~leaves;
    walk.k = walk.searching ? walk.k + 1 : walk.k;
  }
};

}  // namespace voxmelt::render
