// Solids may be of several materials (docs/automaton.md, section 6). Each lane then has numbers of its own.
// Most vectors are of one material, and need no look at each lane.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/engine/cpu/lanes.h"

namespace voxmelt::simd {

// Holds what follows from the materials of a scene, in tables by material.
struct Palette {
  static constexpr std::size_t kMost = rule::kMostMaterials;

  [[gnu::always_inline]] explicit Palette(const rule::Parameters& parameters) {
    const rule::Material& first = parameters.material;
    for (std::size_t m = 0; m < parameters.materials.size(); ++m) {
      const rule::SolidMaterial& row = parameters.materials[m];
      const std::uint32_t melting_point = row.melting_point, lack = 65536 - row.warmth;
      const auto solid_to =
          static_cast<std::uint32_t>((65536 * std::uint64_t{melting_point} + row.warmth - 1) / row.warmth);
      melting[m] = row.melting_point;
      liquid_from[m] = static_cast<std::uint16_t>(solid_to + row.latent_heat);
      beyond[m] = static_cast<std::uint16_t>(liquid_from[m] - melting_point);
      cold[m] = static_cast<std::uint16_t>(lack);
      as_first[m] = melting_point + (melting_point > first.melting_point ? first.latent_heat : 0);
      const std::uint32_t hottest = std::max(melting_point, 65535u - beyond[m]);
      top = std::min({top, hottest, 65535 - (65535 * lack + 65535) / 65536});
      least_liquid_from = std::min<int>(least_liquid_from, liquid_from[m]);
    }
  }

  std::uint16_t melting[kMost] = {}, liquid_from[kMost] = {}, beyond[kMost] = {};  // beyond: F - Tm
  std::uint16_t cold[kMost] = {};                                                  // 65536 - warmth
  std::uint32_t as_first[kMost] = {};  // heat of liquid at the melting point
  std::uint32_t top = 65535;           // highest temperature
  int least_liquid_from = 65535;
};

// Knows the materials of a vector of cells.
template <class Arch>
class MaterialLanes {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] explicit MaterialLanes(const std::uint8_t* materials) : at_(materials) {
    std::uint64_t differ = 0;
    for (int i = 0; i < L::kCount; i += 8) {
      std::uint64_t eight;
      std::memcpy(&eight, materials + i, 8);
      differ |= eight ^ (0x0101010101010101u * materials[0]);
    }
    same_ = differ == 0;
  }

  // Returns the numbers of the lanes in a table by material.
  [[gnu::always_inline]] V of(const std::uint16_t* table) const {
    return same_ ? L::set(table[at_[0]]) : each([&](int i) VOXMELT_LAMBDA { return table[at_[i]]; });
  }
  // Returns the numbers of pairs of lanes in a table by both materials.
  [[gnu::always_inline]] V of(const std::uint16_t (*table)[Palette::kMost],
                              const MaterialLanes& other) const {
    if (same_ && other.same_) return L::set(table[at_[0]][other.at_[0]]);
    return each([&](int i) VOXMELT_LAMBDA { return table[at_[i]][other.at_[i]]; });
  }
  [[gnu::always_inline]] bool all_first() const { return same_ && at_[0] == 0; }

 private:
  template <class Number>
  [[gnu::always_inline]] static V each(const Number& number) {
    alignas(64) std::uint16_t lanes[L::kCount];
    for (int i = 0; i < L::kCount; ++i) lanes[i] = number(i);
    return L::load(lanes);
  }

  const std::uint8_t* at_;
  bool same_;
};

// Returns the temperatures of heat contents.
template <class Arch>
class Curves {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;

 public:
  [[gnu::always_inline]] explicit Curves(const rule::Parameters& parameters) : palette_(parameters) {}
  [[gnu::always_inline]] V operator()(V heat, const MaterialLanes<Arch>& materials) const {
    const V cold = materials.of(palette_.cold);
    const V lost = L::carry(L::high(heat, cold), L::low(heat, cold), L::zero());  // rounded up
    return curve(heat - lost, heat, materials.of(palette_.melting), materials.of(palette_.beyond));
  }
  // Returns those of liquid.
  [[gnu::always_inline]] V operator()(V heat) const {
    return curve(heat, heat, L::set(palette_.melting[0]), L::set(palette_.beyond[0]));
  }
  [[gnu::always_inline]] int least_liquid_from() const { return palette_.least_liquid_from; }

 private:
  [[gnu::always_inline]] V curve(V warm, V heat, V melting, V beyond) const {
    const V later = L::max(melting, L::sub_saturated(heat, beyond));
    return L::min(L::min(warm, later), L::set(static_cast<int>(palette_.top)));
  }

  const Palette palette_;
};

}  // namespace voxmelt::simd
