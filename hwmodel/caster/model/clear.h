// Clear matter lets a part of the light through (docs/picture/translucent.md). The numbers of a ray's
// surfaces and ways tell how much.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/arithmetic.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/shade.h"

namespace voxmelt::hwmodel::raycast {

// Tabulates what passes, in 2^-15: a memory of 2048 words, 256 of which halve the light (section 2).
inline constexpr std::size_t kNothingPasses = 2047;
inline constexpr auto kPassing = [] {
  std::array<std::uint16_t, kNothingPasses + 1> values{};
  std::int64_t e = std::int64_t{1} << 30;
  for (std::size_t i = 0; i < kNothingPasses; ++i) {
    values[i] = static_cast<std::uint16_t>((e + (1 << 14)) >> 15);
    e = (e * 1070838486 + (std::int64_t{1} << 29)) >> 30;
  }
  return values;
}();

// These return the length of a step in 2^-16 cells, and of a part of it. The part takes one product of 12
// bits by 15 (section 4).
inline UInt<15> length_of_step(Vec step, Vec to_eye) { return dot((Vec{} - step) >> 4, to_eye) >> 14; }
inline UInt<18> part_of_step(std::int64_t length, std::int64_t a, int bits) { return (length * a) >> bits; }

// Holds what surfaces and ways have left of a ray.
struct Left {
  UInt<13> surfaces = 4096;
  UInt<27> way = 0;
};
// Takes three products by the losses, three reads, and three products by what surfaces have left.
inline Rgb passed_of(const LookRegisters& look, const Left& left) {
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c) {
    const UInt<31> lost = (left.way >> 8) * look.losses[c];
    const auto i = std::min(static_cast<std::size_t>(lost >> 12), kNothingPasses);
    color[c] = static_cast<std::int32_t>(UInt<16>((left.surfaces * kPassing[i]) >> 12));
  }
  return color;
}
inline UInt<13> dimmed(std::int64_t left, std::int64_t lost) { return (left * (4096 - lost)) >> 12; }
inline UInt<27> further(std::int64_t way, std::int64_t by) {
  return std::min(way + by, (std::int64_t{1} << 27) - 1);
}

// Returns the light at a place in matter, from all sides (section 6). 43 is a constant, and takes three sums.
inline Rgb inner_light(const LookRegisters& look, const Light& light) {
  const std::int64_t beside = light.open[0] + light.open[1] + light.open[4] + light.open[5];
  const UInt<8> above = ((2 * light.open[2] + beside) * 43) >> 9;
  const UInt<8> below = ((2 * light.open[3] + beside) * 43) >> 9;
  Rgb color{};
  for (std::size_t c = 0; c < 3; ++c)
    color[c] =
        static_cast<std::int32_t>(UInt<13>(((look.from_above[c] * above + look.from_below[c] * below) >> 8) +
                                           ((look.lamp[c] * whole(light.lamp)) >> 9)));
  return color;
}

// Holds the sums of a ray. An event of it is a surface or a way.
struct Passage {
  Left left;
  Rgb passed{1 << 15, 1 << 15, 1 << 15};
  Rgb mirrored{}, scattered{};

  bool dark() const { return passed == Rgb{}; }
};
inline void scatter(const LookRegisters& look, Passage& passage, const Rgb& before, const Rgb& color) {
  passage.passed = passed_of(look, passage.left);
  for (std::size_t c = 0; c < 3; ++c) passage.scattered[c] += (before[c] - passage.passed[c]) * color[c];
  for (const std::int32_t one : passage.scattered) static_cast<void>(SInt<29>(one));
}
inline void pass_surface(const LookRegisters& look, Passage& passage, const Rgb& gleam, const Rgb& body,
                         std::int64_t more, std::int64_t obstacle) {
  for (std::size_t c = 0; c < 3; ++c)
    passage.mirrored[c] += static_cast<std::int32_t>((std::int64_t{passage.passed[c]} * gleam[c]) >> 15);
  check_wires<31>(passage.mirrored);
  passage.left.surfaces = dimmed(passage.left.surfaces, more);
  const Rgb before = passed_of(look, passage.left);
  passage.left.surfaces = dimmed(passage.left.surfaces, mixed(look.frost, 4096, obstacle));
  scatter(look, passage, before, body);
}
inline void pass_way(const LookRegisters& look, Passage& passage, std::int64_t way, const Rgb& body,
                     std::int64_t obstacle) {
  const Rgb before = passage.passed;
  passage.left.way = further(passage.left.way, way);
  passage.left.surfaces = dimmed(passage.left.surfaces, obstacle);
  scatter(look, passage, before, body);
}

// Returns the pressed light of a ray that ends at the ground, or on the background (section 7).
inline Rgb seen_through(const LookRegisters& look, const Passage& passage, bool on_ground,
                        const Rgb& behind) {
  Rgb light{};
  for (std::size_t c = 0; c < 3; ++c) {
    const SInt<32> passes = std::int64_t{passage.passed[c]} * behind[c];
    const std::int64_t sum =
        passage.mirrored[c] + ((passage.scattered[c] + (on_ground ? std::int64_t{passes} : 0)) >> 15);
    const std::int64_t pressed = look.tone[std::clamp<std::int64_t>(sum, 0, 12287)];
    light[c] = static_cast<std::int32_t>(on_ground ? pressed
                                                   : std::min<std::int64_t>(pressed + (passes >> 15), 4096));
  }
  return light;
}

}  // namespace voxmelt::hwmodel::raycast
