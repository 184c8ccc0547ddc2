// The ray caster's colours are tested alone, by the worked pixel (docs/picture/trace.md, section 4). Hand
// computations add what it does not show: glow, obstacles, and each of eight neighbours.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "hwmodel/caster/model/shade.h"

namespace voxmelt::hwmodel::raycast {
namespace {

// Entry i is power(32 i, shininess) >> 3 (picture-light.md, section 2), squared from the highest bit down.
std::array<std::uint16_t, 1026> highlights(unsigned shininess) {
  std::array<std::uint16_t, 1026> values{};
  for (std::int64_t i = 0; i < 1026; ++i) {
    const std::int64_t x = 32 * (i < 1024 ? i : 1024);
    std::int64_t result = 32768;
    for (unsigned bit = 1U << 31; bit > 0; bit /= 2) {
      if (bit > shininess) continue;
      result = (result * result + 16384) / 32768;
      if ((shininess & bit) != 0) result = (result * x + 16384) / 32768;
    }
    values[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(result / 8);
  }
  return values;
}

LookRegisters worked_look() {
  LookRegisters registers;
  registers.to_light = {-7947, 11921, 7948};
  registers.to_strip = {10319, 7446, -10321};
  registers.lamp = {3907, 3686, 3391};
  registers.from_below = {461, 461, 461};
  registers.from_above = {963, 1024, 1106};
  registers.solid = {{1766, 1178, 589}, {1594, 1082, 570}, {1197, 968, 742}, 2036};
  registers.liquid = {{589, 1178, 1766}, {594, 1106, 1618}, {1221, 1383, 1484}, 2294};
  registers.obstacle = {{2294, 2294, 2294}, {10, 10, 10}, {117, 111, 102}, 104};
  registers.lamp_low = 3113;
  registers.lamp_high = 3905;
  registers.strip_low = 2867;
  registers.highlight = highlights(12);
  registers.dull_highlight.fill(4096);
  registers.surroundings[1371] = registers.surroundings[1373] = 1;
  registers.surroundings[1372] = 2576 / 2 | 2692 / 2 << 11 | 2884U / 4 << 22;
  return registers;
}
Light worked_light() {
  Light light;
  light.open = {200, 255, 255, 200, 216, 239};
  return light;
}
constexpr Vec kNormal{-1992, 16262, 0}, kToEye{-8002, 3759, 13794};

TEST(RaycastShade, TheWorkedPixelsMatter) {
  const std::array<std::uint32_t, 8> words{255, 255, 0, 0, 255, 255, 0, 0};
  EXPECT_EQ(matter_of(words.data(), spots_of({798690, 3670016, 1660166})), (MatterBytes{255, 0, 0}));
  const Spots at = spots_of({798690, 3670016, 1660166});
  EXPECT_EQ(at.x.weight, 67);
  EXPECT_EQ(at.y.weight, 0);
  EXPECT_EQ(at.z.weight, 21);
  EXPECT_EQ(at.y.cell, 3);
}

// The weights are 64, 128, 192. Liquid: 10 and 90 give 30, 40 and 200 give 80, 0 and 100 give 25, 7 and 255
// give 69. These give 55 and 47, and then 49.
// Heat has the same numbers in reverse order: 255 and 7 give 193, 100 and 0 give 75, 200 and 40 give 160, 90
// and 10 give 70. These give 134 and 115, and then 120. Only the last corner has an obstacle, 255: it gives
// 64, 32, 24.
constexpr std::array<std::uint32_t, 8> kBytes{10, 90, 40, 200, 0, 100, 7, 255};
constexpr Spots kAt{{0, 64}, {0, 128}, {0, 192}};

TEST(RaycastShade, EachCornerOfMatterHasItsWeight) {
  std::array<std::uint32_t, 8> words{};
  for (std::size_t i = 0; i < 8; ++i) words[i] = kBytes[i] | kBytes[7 - i] << 8 | (i == 7 ? 255U << 16 : 0);
  EXPECT_EQ(matter_of(words.data(), kAt), (MatterBytes{49, 120, 24}));
}

TEST(RaycastShade, TheWorkedPixelsLight) {
  std::array<LightWord, 8> words{};
  for (std::size_t i = 0; i < 8; ++i)
    words[i] = {255,
                200,
                255,
                255,
                200,
                static_cast<std::uint8_t>(i < 4 ? 200 : 255),
                static_cast<std::uint8_t>(i < 4 ? 255 : 200)};
  EXPECT_EQ(light_of(words.data(), {{-1, 194}, {2, 126}, {0, 75}}, false), worked_light());
}

// One byte after another is the only one that is not 0.
TEST(RaycastShade, EachByteOfLightHasItsPlace) {
  for (std::size_t byte = 0; byte < 14; ++byte)
    for (const bool glow : {false, true}) {
      std::array<LightWord, 8> words{};
      for (std::size_t i = 0; i < 8; ++i) words[i][byte] = static_cast<std::uint8_t>(kBytes[i]);
      Light expected;
      expected.lamp = 0;
      if (byte == 0) expected.lamp = 49;
      if (byte >= 1 && byte < 7) expected.open[byte - 1] = 49;
      if (byte >= 8 && glow) expected.glow[byte - 8] = 49;
      EXPECT_EQ(light_of(words.data(), kAt, glow), expected) << byte;
    }
}

// (11585 x 11585) >> 14 is 8191. 8191 x 100 + 8191 x 200 is 149 x 2^14 and a rest.
TEST(RaycastShade, SidesAreSeenByTheSignOfADirection) {
  const std::array<std::int32_t, 6> sides{11, 22, 33, 100, 200, 66};
  EXPECT_EQ(seen(sides, {16384, 0, 0}), 11);
  EXPECT_EQ(seen(sides, {-16384, 0, 0}), 22);
  EXPECT_EQ(seen(sides, {0, 16384, 0}), 33);
  EXPECT_EQ(seen(sides, {0, -16384, 0}), 100);
  EXPECT_EQ(seen(sides, {0, 0, 16384}), 200);
  EXPECT_EQ(seen(sides, {0, 0, -16384}), 66);
  EXPECT_EQ(seen(sides, {0, -11585, 11585}), 149);
  EXPECT_EQ(seen({255, 255, 255, 255, 255, 255}, {16500, 0, 300}), 255);  // a little longer than it should be
}

// The normal points down with 16385, and no light comes from below. 963 x (16384 - 16385), shifted down, is
// -1. The light that is scattered of it is -1, too.
TEST(RaycastShade, ANormalThatIsTooLongMayGetLessThanNoLight) {
  LookRegisters look = worked_look();
  look.to_light = {0, 16384, 0};
  look.from_below = {};
  Light light;
  light.open = {255, 255, 255, 255, 255, 255};
  const Arriving arriving = arriving_of(look, {0, -16385, 0}, light, false);
  EXPECT_EQ(arriving.lit, 0);
  EXPECT_EQ(arriving.light, (Rgb{-1, -1, -1}));
  EXPECT_EQ(scattered_color(arriving, {4096, 1, 1}), (Rgb{-1, -1, -1}));
  Mixture mixture;
  mixture.material.diffuse = {4096, 1, 1};
  EXPECT_EQ(matter_color(arriving, mixture, {}), (Rgb{-1, -1, -1}));
}

TEST(RaycastShade, TheWorkedPixelsColour) {
  const LookRegisters look = worked_look();
  const Mixture mixture = mixture_of(look, {255, 0, 0});
  EXPECT_EQ(mixture.l, 4095);
  EXPECT_EQ(mixture.w, 0);
  EXPECT_EQ(mixture.material.diffuse, (Rgb{589, 1178, 1766}));
  EXPECT_EQ(mixture.material.mirror, (Rgb{594, 1106, 1618}));
  EXPECT_EQ(mixture.material.highlight, (Rgb{1221, 1383, 1484}));
  EXPECT_EQ(mixture.material.gloss, 2294);
  EXPECT_EQ(mixture.emission, (Rgb{}));

  const Arriving arriving = arriving_of(look, kNormal, worked_light(), false);
  EXPECT_EQ(arriving.lamp, 256);
  EXPECT_EQ(arriving.facing, 12798);
  EXPECT_EQ(arriving.lit, 13266);
  EXPECT_EQ(arriving.light, (Rgb{4120, 4001, 3843}));
  EXPECT_EQ(seen(worked_light().open, kNormal), 254);

  const Mirrored mirrored = mirrored_of(look, kNormal, kToEye, worked_light(), arriving, mixture);
  EXPECT_EQ(mirrored.peak, 4);
  EXPECT_EQ(mirrored.eye, 4703);
  EXPECT_EQ(mirrored.more, 422);
  EXPECT_EQ(mirrored.reflected, (Vec{6858, 5577, -13794}));
  EXPECT_EQ(mirrored.around, (Rgb{5391, 5708, 6303}));
  EXPECT_EQ(mirrored.free, 3784);
  EXPECT_EQ(seen(worked_light().open, mirrored.reflected), 233);

  EXPECT_EQ(matter_color(arriving, mixture, mirrored), (Rgb{1752, 2971, 4319}));
}

// l = 16 x 128 + 8 = 2056, and w = 73 x 22 = 1606. Red is 1000 + 1004 = 2004, with crust 50 more, then 784
// less. Mirror: 100 + 201 + 392. Highlight: 0 + 1004 - 384. Gloss: 10 + 1004 - 392. Emission: 2490/4096 of
// 2007.
TEST(RaycastShade, GlowAndObstaclesAreMixedIn) {
  LookRegisters look;
  look.solid = {{1000, 1000, 1000}, {100, 100, 100}, {0, 0, 0}, 10};
  look.liquid = {{3000, 3000, 3000}, {500, 500, 500}, {2000, 2000, 2000}, 2010};
  look.obstacle = {{54, 54, 54}, {1301, 1301, 1301}, {24, 24, 24}, 14};
  look.glow_crust[200] = {100, 0, 0};
  look.glow_light[200] = {4000, 0, 8};
  look.glow_crust[199] = look.glow_crust[201] = {77, 77, 77};
  look.glow_light[199] = look.glow_light[201] = {77, 77, 77};
  const MatterBytes bytes{128, 200, 170};
  Mixture mixture = mixture_of(look, bytes);
  EXPECT_EQ(mixture.l, 2056);
  EXPECT_EQ(mixture.w, 1606);
  EXPECT_EQ(mixture.material.diffuse[0], 1239);  // 2004 + rounded(-1950 x 1606, 12)
  EXPECT_EQ(mixture.emission, (Rgb{}));
  look.glow = true;
  mixture = mixture_of(look, bytes);
  EXPECT_EQ(mixture.material.diffuse, (Rgb{1270, 1239, 1239}));
  EXPECT_EQ(mixture.material.mirror, (Rgb{693, 693, 693}));
  EXPECT_EQ(mixture.material.highlight, (Rgb{620, 620, 620}));
  EXPECT_EQ(mixture.material.gloss, 622);
  EXPECT_EQ(mixture.emission, (Rgb{1220, 0, 2}));
  EXPECT_EQ(mixture_of(look, {0, 200, 148}).w, 0);
  EXPECT_EQ(mixture_of(look, {0, 200, 255}).w, 4096);
}

// The same with the solid of tone 200. Without tones it is that of the register: 2000 + 502 = 2502 less
// rounded(2448 x 1606, 12) = 960.
TEST(RaycastShade, SolidsHaveTheMaterialOfTheirTone) {
  LookRegisters look;
  look.solid = {{2000, 2000, 2000}, {0, 0, 0}, {0, 0, 0}, 10};
  look.liquid = {{3000, 3000, 3000}, {500, 500, 500}, {2000, 2000, 2000}, 2010};
  look.obstacle = {{54, 54, 54}, {1301, 1301, 1301}, {24, 24, 24}, 14};
  look.tints[199] = look.tints[201] = look.liquid;
  look.tints[200] = {{1000, 1000, 1000}, {100, 100, 100}, {0, 0, 0}, 10};
  const MatterBytes bytes{128, 200, 170};
  EXPECT_EQ(mixture_of(look, bytes).material.diffuse, (Rgb{1542, 1542, 1542}));
  look.tinted = true;
  const Mixture mixture = mixture_of(look, bytes);
  EXPECT_EQ(mixture.material.diffuse, (Rgb{1239, 1239, 1239}));
  EXPECT_EQ(mixture.material.mirror, (Rgb{693, 693, 693}));
  EXPECT_EQ(mixture.material.highlight, (Rgb{620, 620, 620}));
  EXPECT_EQ(mixture.material.gloss, 622);
  EXPECT_EQ(mixture.emission, (Rgb{}));
}

// facing is 16384, and lit is (18842 x 14247) >> 14 = 16384, of which 100/256 are 6400. From above come 900,
// of which 77/256 are 270. The lamp gives 781, 390, 0. Glow by 9/32 gives 1728, 552, 103.
TEST(RaycastShade, GlowArrivesWhereItIsAskedFor) {
  LookRegisters look;
  look.to_light = {0, 16384, 0};
  look.lamp = {2000, 1000, 0};
  look.from_below = {5, 5, 5};
  look.from_above = {900, 900, 900};
  Light light;
  light.lamp = 100;
  light.open = {1, 2, 77, 3, 4, 5};
  light.glow = {1, 2, 9, 3, 4, 5};
  const Vec up{0, 16384, 0};
  EXPECT_EQ(arriving_of(look, up, light, false).light, (Rgb{1051, 660, 270}));
  EXPECT_EQ(arriving_of(look, up, light, true).light, (Rgb{2779, 1212, 373}));
  // From below, facing -16384 is far behind the edge. The other side of openness counts: (5 x 3) >> 8.
  EXPECT_EQ(arriving_of(look, {0, -16384, 0}, light, false).light, (Rgb{0, 0, 0}));
}

// The mirrored eye looks straight up. Half way between the tables is 2500, and 129/256 of the lamp make it
// 1259. Where the surface turns from the lamp, smooth(0, 1024, 512) is a half.
TEST(RaycastShade, HighlightsOfObstaclesAndOfTheEdge) {
  LookRegisters look;
  look.to_light = {0, 16384, 0};
  look.lamp_low = 3113;
  look.lamp_high = 3905;
  look.strip_low = 2867;
  look.highlight.fill(4000);
  look.dull_highlight.fill(1000);
  Light light;
  Arriving arriving;
  arriving.lamp = 129;
  arriving.facing = 16384;
  Mixture mixture;
  mixture.w = 2048;
  const Vec up{0, 16384, 0};
  EXPECT_EQ(mirrored_of(look, up, up, light, arriving, mixture).peak, 1259);
  arriving.facing = 2048;
  EXPECT_EQ(mirrored_of(look, up, up, light, arriving, mixture).peak, 629);
  arriving.facing = -1;
  EXPECT_EQ(mirrored_of(look, up, up, light, arriving, mixture).peak, 0);
  const Mirrored mirrored = mirrored_of(look, up, up, light, arriving, mixture);
  EXPECT_EQ(mirrored.eye, 16384);
  EXPECT_EQ(mirrored.reflected, up);
  EXPECT_EQ(mirrored.free, 614);                        // nothing is open
  EXPECT_EQ(mirrored.around, (Rgb{9830, 9626, 9216}));  // the middle of the lamp

  std::array<std::uint16_t, 1026> table{};
  table[574] = 160;
  table[575] = 200;
  EXPECT_EQ(highlight_at(table, 9193), 182);  // 574 x 16 + 9: 160 + (40 x 9) / 16
}

// The sum is 4096 + 100 + 1274 + 405. The fresnel term is 1000 + 1548, and a lone emission has (500 x (2540 +
// 778)) >> 12.
TEST(RaycastShade, TheFourTermsOfAColourByHand) {
  Arriving arriving;
  arriving.light = {8192, 0, 0};
  Mixture mixture;
  mixture.material.diffuse = {2048, 2048, 2048};
  mixture.material.highlight = {4096, 4096, 0};
  mixture.material.mirror = {1000, 1000, 1000};
  mixture.emission = {500, 0, 500};
  Mirrored mirrored;
  mirrored.peak = 100;
  mirrored.eye = 8192;
  mirrored.more = 2048;
  mirrored.free = 2048;
  mirrored.around = {4096, 4096, 0};
  EXPECT_EQ(matter_color(arriving, mixture, mirrored), (Rgb{5875, 1374, 405}));
  EXPECT_EQ(scattered_color(arriving, {100, 100, 100}), (Rgb{200, 0, 0}));
}

TEST(RaycastShade, SmoothAndItsQuotient) {
  EXPECT_EQ(smooth(1000, 2000, 1500), 2048);
  EXPECT_EQ(smooth(1000, 2000, 999), 0);
  EXPECT_EQ(smooth(1000, 2000, 2001), 4096);
  EXPECT_EQ(smooth(0, 4096, 1024), 640);  // (1024 x 1024 x 10240) >> 24
  EXPECT_EQ(divided(-7, 2), -4);
  EXPECT_EQ(divided(-8, 2), -4);
  EXPECT_EQ(divided(7, 2), 3);
  EXPECT_EQ(whole(255), 256);
  EXPECT_EQ(whole(127), 127);
  EXPECT_EQ(whole(128), 129);
}

}  // namespace
}  // namespace voxmelt::hwmodel::raycast
