// Surfaces get a wrong normal, colour of ground, matter or light.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwmodel/caster/faults/planted.h"

namespace voxmelt::hwmodel::raycast {

class SurfaceFaults : public Planted {
 public:
  using Planted::Planted;

  void sampled(const Levels& levels, SInt<16>& level) {
    const Vec& q = levels.request.at;
    constexpr std::int64_t kOne = 1 << 12;  // one unit of a weight
    const auto try_at = [&](std::int64_t x, std::int64_t y, std::int64_t z) {
      const auto room = [](std::int64_t at, std::int64_t more) {
        return weight_of(at) < 255 ? at + more : at;
      };
      const std::int64_t wrong = sample_of(levels.words.data(), {room(q.x, x), room(q.y, y), room(q.z, z)});
      replace_level(levels, level, wrong);
    };
    if (armed(Fault::sample_weight_x)) try_at(kOne, 0, 0);
    if (armed(Fault::sample_weight_y)) try_at(0, kOne, 0);
    if (armed(Fault::sample_weight_z)) try_at(0, 0, kOne);
    if (armed(Fault::sample_rounding)) {
      const Vec plane{q.x, q.y, (q.z >> kCellBits) << kCellBits};  // its weight along z is 0
      std::array<std::int16_t, 8> upper{};
      for (std::size_t i = 0; i < 4; ++i) upper[i] = levels.words[4 + i];
      const std::int64_t below = sample_of(levels.words.data(), plane),
                         above = sample_of(upper.data(), plane), wz = weight_of(q.z);
      replace_level(levels, level, (below * (256 - wz) + above * wz) >> 8);
    }
  }

  void inclined(const Slope& slope, Surface& surface) {
    const Vec& n = surface.normal;
    if (armed(Fault::normal_axes)) replace("normal", surface.id, surface.normal, Vec{n.z, n.y, n.x});
    if (armed(Fault::normal_root))
      replace("normal", surface.id, surface.normal, with_next_root(Vec{} - slope.slope));
  }

  void painted(const GroundRegisters& ground, Surface& surface) {
    const Vec& n = surface.normal;
    const bool side = surface.face != Face::none && surface.face != Face::under && surface.face != Face::top;
    if (armed(Fault::paint_side) && side) replace("paint", surface.id, surface.normal, Vec{} - n);
    if (armed(Fault::paint_band) && side)
      replace("paint", surface.id, surface.color,
              cut_color(ground, surface.position + Vec{0, kCell / 4, 0}, surface.face));
    if (armed(Fault::paint_top) && surface.face == Face::top)
      replace("paint", surface.id, surface.normal, Vec{n.z, n.y, n.x});
  }
  void textured(const TexelGather::Out& answer, Vec smooth, Vec bump, Surface& surface) {
    if (armed(Fault::texture_bump))
      replace("texture", surface.id, surface.normal, unit_of(smooth + Vec{-bump.x, 0, bump.z}));
    const Texel& low = answer.words[0];
    if (armed(Fault::texture_texel))
      replace("texture", surface.id, surface.color, Rgb{low.red, low.green, low.blue});
  }

  void known(int which, const Surface& surface, MatterBytes& bytes) {
    if (armed(Fault::matter_share) && which == 0)
      replace("matter", surface.id, bytes, {bytes.heat, bytes.liquid, bytes.obstacle});
    if (armed(Fault::matter_place) && which == 1)
      replace("matter", surface.id, bytes.obstacle, surface.matter.obstacle);
  }

  void lighted(const LightGather::Out& answer, bool glow, Surface& surface) {
    Light wrong = surface.light;
    if (armed(Fault::light_cell)) {
      auto words = answer.words;
      for (std::size_t i = 0; i < 8; i += 2) words[i + 1] = words[i];
      wrong = light_of(words.data(), answer.request.at, glow);
    }
    if (armed(Fault::light_side)) std::swap(wrong.open[0], wrong.open[1]);
    if (armed(Fault::light_glow)) std::swap(wrong.glow[2], wrong.glow[3]);
    replace("light", surface.id, surface.light, wrong);
  }

 private:
  void replace_level(const Levels& levels, SInt<16>& level, std::int64_t wrong) {
    if (wrong == level) return;
    level = wrong;
    strike("sample", levels.request.id);
  }
  // Computes unit() with the next entry of the table.
  static Vec with_next_root(Vec g) {
    if (g == Vec{}) return {};
    const int n = 15 - bits_of(largest(g));
    g = {g.x << n, g.y << n, g.z << n};
    const std::int64_t q = dot(g, g);
    const int e = q < (std::int64_t{1} << 30) ? 1 : 0;
    const auto i = static_cast<std::size_t>((q << (2 * e)) >> 23) - 128;
    const std::int64_t by = std::int64_t{kInverseRoot[i + 1]} << e;
    return {rounded(g.x * by, 16), rounded(g.y * by, 16), rounded(g.z * by, 16)};
  }
};

}  // namespace voxmelt::hwmodel::raycast
