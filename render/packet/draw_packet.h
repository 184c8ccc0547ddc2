// Places of the picture to pressed light, one packet after the other.
#pragma once

#include <cstddef>

#include "render/packet/shade_packet.h"

namespace voxmelt::render {

template <class Arch>
struct DrawPacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using Field = FieldPacket<Arch>;
  using Shade = ShadePacket<Arch>;
  using Color = typename Shade::Color;

  [[gnu::always_inline]] static inline Color light(const PictureData& data, V across, V down) {
    const auto row = Rays<Arch>::through(data, across, down);
    const auto hits = Field::march(data, row);
    Color color{{L::set(data.background[0]), L::set(data.background[1]), L::set(data.background[2])}};
    if (L::any(hits.found)) {
      const auto surface = Field::crossing(data.field, row, hits);
      const Triple to_eye = P::unit_of(Triple{} - row.step, data.inverse_root);
      const Triple normal = P::select(hits.sample == 0, to_eye, Field::normal(data, surface.at));
      const Triple position = surface.at + Triple{L::set(-Field::kBias), L::set(-Field::kBias), L::set(-Field::kBias)};
      const auto arriving = LightPacket<Arch>::at(data.light, data.paint->glow,
                                                  LightPacket<Arch>::before(position, normal, data.light.shift));
      const V matter = Field::matter(data.field, surface.at);
      const V outside = data.field.obstacles ? Field::matter(data.field, surface.at + (normal << 5)) : V{};
      color = Shade::select(
          hits.found,
          Shade::pressed(*data.tone, Shade::matter_color(data, normal, to_eye, arriving, matter, (outside >> 16) & 255)),
          color);
    }
    return color;
  }

  // Places are rounded up to whole packets: see Places.
  static void draw(const PictureData& data, Places places, PressedLight to) {
    for (std::size_t i = 0; i < places.count; i += P::kCount) {
      const Color of = light(data, L::load(places.across + i), L::load(places.down + i));
      L::store_halves(of.c[0], to.red + i);
      L::store_halves(of.c[1], to.green + i);
      L::store_halves(of.c[2], to.blue + i);
    }
  }
};

template <class Arch>
Packets packets_for() {
  return {&DrawPacket<Arch>::draw, Packet<Arch>::kCount};
}

}  // namespace voxmelt::render
