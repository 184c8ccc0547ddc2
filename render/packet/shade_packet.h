// The surfaces of a packet get their colours (rule/shade.h, rule/tone.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "render/packet/light_packet.h"

namespace voxmelt::render {

template <class Arch>
struct ShadePacket : Packet<Arch> {
  using P = Packet<Arch>;
  using typename P::L;
  using typename P::Triple;
  using typename P::V;
  using Lights = LightPacket<Arch>;
  using Light = typename Lights::Light;

  struct Color {
    V c[3];
  };
  VOXMELT_WORDS Color select(V mask, const Color& a, const Color& b) {
    return {{mask ? a.c[0] : b.c[0], mask ? a.c[1] : b.c[1], mask ? a.c[2] : b.c[2]}};
  }

  VOXMELT_WORDS Triple constant(picture::Vector v) {
    return {L::set(static_cast<std::int32_t>(v.x)), L::set(static_cast<std::int32_t>(v.y)),
            L::set(static_cast<std::int32_t>(v.z))};
  }
  VOXMELT_WORDS V cosine(Triple a, Triple b) { return P::dot(a, b) >> 14; }
  VOXMELT_WORDS V whole(V byte) { return byte + (byte >> 7); }

  // Returns picture::smooth_light (rule/look.h). t is exact, because it is the quotient of two floats below
  // 2^24, rounded down.
  VOXMELT_WORDS V smooth_step(std::int32_t low, std::int32_t high, V at) {
    const V within = L::clamp(at - low, 0, high - low);
    const V t = L::to_int(L::to_float(within * 4096) / static_cast<float>(high - low));
    const V square = t * t;  // 2^24 at most
    // The result is (t^2 (12288 - 2 t)) >> 24, in two parts of t^2.
    const V by = 12288 - 2 * t;
    return ((square >> 12) * by + (((square & 4095) * by) >> 12)) >> 12;
  }

  VOXMELT_WORDS Color arriving(const picture::Paint& paint, Triple normal, const Light& light, bool glows) {
    const V lamp = whole(Lights::lamp(light));
    const V facing = cosine(normal, constant(paint.to_light));
    const V lit = (((L::max(facing + 2458, V{}) * 14247) >> 14) * lamp) >> 8;
    const V open = whole(Lights::open(light, normal));
    const V glow = glows ? Lights::glow(light, normal) : V{};
    const V up = normal.y + picture::kLength;
    Color sum;
    for (std::size_t c = 0; c < 3; ++c) {
      const V ambient = paint.from_below[c] + (((paint.from_above[c] - paint.from_below[c]) * up) >> 15);
      sum.c[c] =
          ((ambient * open) >> 8) + ((paint.lamp[c] * lit) >> 14) + ((picture::kGlowLight[c] * glow) >> 5);
    }
    return sum;
  }

  VOXMELT_WORDS Color mirrored(const picture::Paint& paint, Triple direction) {
    const V height = L::clamp(direction.y + picture::kLength, 0, 2 * picture::kLength);
    const V packed = L::template gather<4>(paint.surroundings.data(), height >> 4);
    const V lamp =
        smooth_step(paint.lamp_low, paint.lamp_high, cosine(direction, constant(paint.to_light)) >> 2);
    const V strip =
        smooth_step(paint.strip_low, picture::kStripHigh, cosine(direction, constant(paint.to_strip)) >> 2);
    const V around[3] = {(packed & 2047) << 1, ((packed >> 11) & 2047) << 1, ((packed >> 22) & 1023) << 2};
    Color sum;
    for (std::size_t c = 0; c < 3; ++c)
      sum.c[c] = around[c] + ((picture::kMirroredLamp[c] * lamp) >> 12) +
                 ((picture::kMirroredStrip[c] * strip) >> 12);
    return sum;
  }

  VOXMELT_WORDS V highlight_at(const picture::Highlight& table, V cosine) {
    const V pair = L::template gather<2>(table.data(), cosine >> 4);
    const V below = pair & 0xFFFF, above = L::as_signed(L::as_unsigned(pair) >> 16);
    return below + (((above - below) * (cosine & 15)) >> 4);
  }

  struct Material {
    Color diffuse, mirror, highlight;
    V gloss;
  };

  VOXMELT_WORDS Material mixed(const picture::Material& a, const picture::Material& b, V share) {
    Material material;
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse.c[c] = P::mixed(a.diffuse[c], b.diffuse[c], share);
      material.mirror.c[c] = P::mixed(a.mirror[c], b.mirror[c], share);
      material.highlight.c[c] = P::mixed(a.highlight[c], b.highlight[c], share);
    }
    material.gloss = P::mixed(a.gloss, b.gloss, share);
    return material;
  }
  VOXMELT_WORDS void mix_in(Material& a, const picture::Material& b, V share) {
    for (std::size_t c = 0; c < 3; ++c) {
      a.diffuse.c[c] = P::mixed(a.diffuse.c[c], L::set(b.diffuse[c]), share);
      a.mirror.c[c] = P::mixed(a.mirror.c[c], L::set(b.mirror[c]), share);
      a.highlight.c[c] = P::mixed(a.highlight.c[c], L::set(b.highlight[c]), share);
    }
    a.gloss = P::mixed(a.gloss, L::set(b.gloss), share);
  }

  // Reads the material of a solid's tone, which is in the byte of heat.
  VOXMELT_WORDS V tint_of(const picture::Paint& paint, V matter, picture::Color picture::Material::*part,
                          std::size_t channel) {
    constexpr int kStep = sizeof(picture::Material) / sizeof(std::int32_t);
    return L::template gather<4>((paint.tints[0].*part).data() + channel, ((matter >> 8) & 255) * kStep);
  }
  VOXMELT_WORDS Material of_solid_and_liquid(const picture::Paint& paint, V matter, V liquid) {
    if (!paint.tinted) return mixed(paint.solid, paint.liquid, liquid);
    Material material;
    for (std::size_t c = 0; c < 3; ++c) {
      material.diffuse.c[c] = tint_of(paint, matter, &picture::Material::diffuse, c);
      material.mirror.c[c] = tint_of(paint, matter, &picture::Material::mirror, c);
      material.highlight.c[c] = tint_of(paint, matter, &picture::Material::highlight, c);
    }
    material.gloss = L::set(paint.solid.gloss);  // it has nothing to do with the colour
    mix_in(material, paint.liquid, liquid);
    return material;
  }

  VOXMELT_WORDS V obstacle_share(V byte) { return L::clamp((byte - 148) * 73, 0, picture::kLight); }

  struct Shine {
    Color mirrored, scattered, emission;
    V more, obstacle;
  };

  // Returns the parts of the light from a surface. `matter` holds liquid, heat (or tone) and obstacle as
  // bytes of a lane. `normal` and `out` are those of rule/shade.h.
  VOXMELT_WORDS Shine shine_of(const PictureData& data, Triple normal, Triple out, Triple to_eye,
                               const Light& light, V matter, V obstacle_byte) {
    const picture::Paint& paint = *data.paint;
    const V liquid_byte = matter & 255, liquid = (liquid_byte << 4) + (liquid_byte >> 4);
    const V obstacle = obstacle_share(obstacle_byte);
    Material material = of_solid_and_liquid(paint, matter, liquid);
    Color emission{};
    if (paint.glow) {
      const V heat = ((matter >> 8) & 255) * 3;
      for (std::size_t c = 0; c < 3; ++c) {
        const V crust = L::template gather<4>(paint.glow_colors.crust.data()->data() + c, heat);
        const V shine = L::template gather<4>(paint.glow_colors.light.data()->data() + c, heat);
        material.diffuse.c[c] = material.diffuse.c[c] + ((crust * liquid) >> 12);
        emission.c[c] = (((shine * liquid) >> 12) * (picture::kLight - obstacle)) >> 12;
      }
    }
    const bool obstacles = data.field.obstacles;
    if (obstacles) mix_in(material, paint.obstacle, obstacle);

    Color arrives = arriving(paint, out, light, false);
    if (paint.glow && obstacles) arrives = select(obstacle > 0, arriving(paint, out, light, true), arrives);
    const V lamp = whole(Lights::lamp(light));
    const V facing = cosine(normal, constant(paint.to_light));
    const Triple halfway = P::unit_of(constant(paint.to_light) + to_eye, data.inverse_root);
    const V bright = L::clamp(cosine(normal, halfway), 0, picture::kLength);
    V peak = highlight_at(paint.highlight, bright);
    if (obstacles) peak = P::mixed(peak, highlight_at(paint.dull_highlight, bright), obstacle);
    peak = (((peak * smooth_step(0, 1024, facing >> 2)) >> 12) * lamp) >> 8;

    const V eye = L::clamp(cosine(normal, to_eye), 0, picture::kLength);
    const V away = picture::kLength - eye, away2 = (away * away) >> 14, away4 = (away2 * away2) >> 14;
    const V more = (((away4 * away) >> 14) * material.gloss) >> 14;
    const V twice = (2 * P::dot(normal, to_eye)) >> 14;
    const Triple reflected = ((normal * twice) >> 14) - to_eye;
    const Color around = mirrored(paint, reflected);
    const V seen =
        614 + ((whole(Lights::open(light, reflected)) * whole(Lights::open(light, normal)) * 3482) >> 16);

    Shine result{{}, {}, emission, more, obstacle};
    for (std::size_t c = 0; c < 3; ++c) {
      const V fresnel = material.mirror.c[c] + (((picture::kLight - material.mirror.c[c]) * more) >> 12);
      const V mirror = (((around.c[c] * seen) >> 12) * fresnel) >> 12;
      result.mirrored.c[c] = ((material.highlight.c[c] * peak) >> 12) + mirror;
      result.scattered.c[c] = (arrives.c[c] * material.diffuse.c[c]) >> 12;
      if (paint.glow) result.emission.c[c] = (emission.c[c] * (2540 + ((1556 * eye) >> 14))) >> 12;
    }
    return result;
  }

  VOXMELT_WORDS Color matter_color(const PictureData& data, Triple normal, Triple to_eye, const Light& light,
                                   V matter, V obstacle_byte) {
    const Shine shine = shine_of(data, normal, normal, to_eye, light, matter, obstacle_byte);
    Color sum;
    for (std::size_t c = 0; c < 3; ++c) {
      sum.c[c] = shine.scattered.c[c] + shine.mirrored.c[c];
      if (data.paint->glow) sum.c[c] = sum.c[c] + shine.emission.c[c];
    }
    return sum;
  }

  // Returns the light that clear matter scatters at a place in it.
  VOXMELT_WORDS Color inner_color(const PictureData& data, const Light& light, V matter) {
    const picture::Paint& paint = *data.paint;
    const V liquid_byte = matter & 255, liquid = (liquid_byte << 4) + (liquid_byte >> 4);
    const V lamp = whole(Lights::lamp(light));
    const auto side = [&](int i) {
      return Lights::byte(i < 3 ? light.lamp_open : light.open, i < 3 ? i + 1 : i - 3);
    };
    const V beside = side(0) + side(1) + side(4) + side(5);
    const V above = ((2 * side(2) + beside) * 43) >> 9, below = ((2 * side(3) + beside) * 43) >> 9;
    Color color;
    for (std::size_t c = 0; c < 3; ++c) {
      const V inner =
          ((paint.from_above[c] * above + paint.from_below[c] * below) >> 8) + ((paint.lamp[c] * lamp) >> 9);
      const V solid = paint.tinted ? tint_of(paint, matter, &picture::Material::diffuse, c)
                                   : L::set(paint.solid.diffuse[c]);
      V diffuse = P::mixed(solid, L::set(paint.liquid.diffuse[c]), liquid);
      if (data.field.obstacles)
        diffuse = P::mixed(diffuse, L::set(paint.obstacle.diffuse[c]), obstacle_share((matter >> 16) & 255));
      color.c[c] = (inner * diffuse) >> 12;
    }
    return color;
  }

  VOXMELT_WORDS Color ground_color(const picture::Paint& paint, Triple normal, const Light& light,
                                   const Color& color) {
    const Color arrives = arriving(paint, normal, light, paint.glow);
    Color sum;
    for (std::size_t c = 0; c < 3; ++c) sum.c[c] = (arrives.c[c] * color.c[c]) >> 12;
    return sum;
  }

  VOXMELT_WORDS Color pressed(const picture::Tone& tone, const Color& light) {
    Color color;
    for (std::size_t c = 0; c < 3; ++c)
      color.c[c] = L::template gather<2>(tone.data(), L::clamp(light.c[c], 0, picture::kBrightest)) & 0xFFFF;
    return color;
  }
};

}  // namespace voxmelt::render
