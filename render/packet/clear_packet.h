// What a packet's rays see through clear matter (rule/clear.h, clear_painter.h).
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

  // The ground on the rays: places in parts of steps, and the bias of rule/nearer.h.
  struct Ground {
    V found, part, first;
  };

  struct Rest {
    const PictureData& data;
    const Row& row;
    Triple to_eye;
    V step;  // its length
    V surfaces, way;
    Color mirrored, scattered;

    [[gnu::always_inline]] Color passed() const {
      const picture::Paint& paint = *data.paint;
      Color of;
      for (std::size_t c = 0; c < 3; ++c) {
        const V i = L::min(((way >> 8) * paint.losses[c]) >> 12, L::set(picture::kNothingPasses));
        of.c[c] = (surfaces * (L::template gather<2>(paint.passing.data(), i) & 0xFFFF)) >> 12;
      }
      return of;
    }
    [[gnu::always_inline]] V dark() const {
      const Color left = passed();
      return (left.c[0] | left.c[1] | left.c[2]) == 0;
    }
    // a / 2^kBits of a step.
    template <int kBits>
    [[gnu::always_inline]] V part(V a) const {
      return (step * a) >> kBits;
    }
    [[gnu::always_inline]] void dim(V rays, V lost) {
      surfaces = rays ? (surfaces * (picture::kLight - lost)) >> 12 : surfaces;
    }
    // Of rays whose numbers have not changed, nothing.
    [[gnu::always_inline]] void scatter(const Color& before, const Color& color) {
      const Color after = passed();
      for (std::size_t c = 0; c < 3; ++c)
        scattered.c[c] = scattered.c[c] + (before.c[c] - after.c[c]) * color.c[c];
    }

    // Some rays enter or leave matter at a lattice position.
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

    // Some rays walk through matter, with what is at a lattice position.
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

  // Tells which rays get to the ground.
  [[gnu::always_inline]] static inline V follow(Rest& rest, const Ground& ground) {
    const PictureData& data = rest.data;
    const Row& row = rest.row;
    const V sample_before = ground.part >> picture::kPartBits;
    const V last = ground.found ? sample_before : L::set(INT32_MAX - 1), most = last + 1;
    const int stretch = 1 << data.spacing;
    V arrived{}, searching = L::set(-1), within{}, k{}, level{}, way{};
    Triple at{};
    for (;;) {
      if (L::any(searching)) {
        const auto hits = Field::march(data, row, searching, k, most);
        arrived = arrived | (searching & ground.found & ~hits.found);
        searching = V{};
        V enters = hits.found;
        if (L::any(enters)) {
          const auto surface = Field::crossing(data.field, row, hits);
          const V samples = L::clamp(sample_before - (hits.sample - 1), -8, 8);
          const V place = samples * picture::kPlaces +
                          (ground.part & (picture::kParts - 1)) * (picture::kPlaces / picture::kParts);
          const V below = enters & ground.found & (place <= surface.part + ground.first);
          arrived = arrived | below;
          enters = enters & ~below;
          const V crosses = enters & (hits.sample != 0);
          if (L::any(crosses)) rest.surface(crosses, surface.at, crosses);
          enters = enters & ~rest.dark();
          k = enters ? hits.sample : k;
          level = enters ? hits.level : level;
          at = P::select(enters, hits.at, at);
          const V soon = enters & (k > last);
          if (L::any(soon)) rest.walk(soon, at, rest.template part<11>(place - surface.part));
          arrived = arrived | soon;
          enters = enters & ~soon;
          way = enters ? rest.template part<11>(picture::kPlaces - surface.part) : way;
          within = within | enters;
        }
      }
      if (!L::any(within)) return arrived;

      V leaves{}, going = within;
      for (int i = 0; i < stretch; ++i) {
        going = going & (k < last);
        if (!L::any(going)) break;
        const Triple next = P::select(going, at + row.step, Triple{});
        const V here = Field::sample(data.field, next), air = going & (here < 0);
        leaves = leaves | air;
        going = going & ~air;
        k = k - going;
        way = going ? way + rest.step : way;
        level = going ? here : level;
        at = P::select(going, next, at);
      }
      const V ends = within & ~leaves & (k == last);
      way = ends ? way + rest.template part<8>(ground.part & (picture::kParts - 1)) : way;
      Triple exit{};
      if (L::any(leaves)) {
        const auto surface = Field::crossing_between(data.field, P::select(leaves, at + row.step, Triple{}),
                                                     P::select(leaves, at, Triple{}), level);
        way = leaves ? way + rest.template part<11>(picture::kPlaces - surface.part) : way;
        exit = surface.at;
      }
      rest.walk(within, at, way);
      way = V{};
      if (L::any(leaves)) rest.surface(leaves, exit, V{});
      arrived = arrived | ends;
      within = within & ~ends & ~rest.dark();
      searching = within & leaves;
      within = within & ~leaves;
      k = searching ? k + 1 : k;
    }
  }
};

}  // namespace voxmelt::render
