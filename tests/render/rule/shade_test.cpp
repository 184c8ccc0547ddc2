// Look, tables, tone and shading are tested by hand, and against double.
#include "render/rule/shade.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>

#include "render/rule/antialias.h"
#include "render/rule/tone.h"

namespace voxmelt::picture {
namespace {

double srgb(double light) {
  return 255 * (light <= 0.0031308 ? 12.92 * light : 1.055 * std::pow(light, 1 / 2.4) - 0.055);
}

TEST(Look, SmoothStepsByHand) {
  EXPECT_EQ(smooth_light(0, 4096, -1), 0);
  EXPECT_EQ(smooth_light(0, 4096, 2048), 2048);
  EXPECT_EQ(smooth_light(0, 4096, 1024), 640);  // 3/16 - 2/64 = 10/64
  EXPECT_EQ(smooth_light(100, 300, 301), 4096);
  EXPECT_EQ(mixed(100, 200, 4096), 200);
  EXPECT_EQ(mixed(100, 200, 1024), 125);
  EXPECT_EQ(mixed(200, 100, 1024), 175);
}

TEST(Look, AMetalMirrorsItsColourAndAWaxLittle) {
  const Color lamp{4096, 4096, 4096};
  const Material metal = material_of({2048, 1024, 512}, 4096, 4096, lamp);
  EXPECT_EQ(metal.mirror, (Color{2048, 1024, 512}));
  EXPECT_EQ(metal.diffuse, (Color{307, 154, 77}));  // 0.15 of it
  EXPECT_EQ(metal.highlight, (Color{2048, 1024, 512}));
  EXPECT_EQ(metal.gloss, 2867);
  const Material wax = material_of({2048, 1024, 512}, 2048, 0, lamp);
  EXPECT_EQ(wax.diffuse, (Color{2048, 1024, 512}));
  EXPECT_EQ(wax.mirror, (Color{164, 164, 164}));
  EXPECT_EQ(wax.highlight, (Color{2048, 2048, 2048}));
  EXPECT_EQ(wax.gloss, 1720);  // 0.7 x 1.2 x 2048 = 1720.3
}

TEST(Tables, PowersAreThoseOfDouble) {
  for (const std::int32_t exponent : {1, 2, 12, 40, 60, 200})
    for (std::int32_t x = 0; x <= 32768; x += 97)
      EXPECT_NEAR(power(x, exponent), 32768 * std::pow(x / 32768.0, exponent), 16) << x << ' ' << exponent;
  EXPECT_EQ(power(32768, 1000000), 32768);
}

TEST(Tables, HighlightIsLinearBetweenEntries) {
  const Highlight table = highlight_of(40);
  EXPECT_EQ(highlight_at(table, kLength), 4096);
  for (std::int32_t c = 0; c <= kLength; c += 13)
    EXPECT_NEAR(highlight_at(table, c), 4096 * std::pow(c / 16384.0, 40), 8) << c;
}

TEST(Tables, SurroundingsByHeight) {
  Look look;
  look.ground = {1000, 2000, 3000};
  look.shininess = 1000000;  // the sharpest: a blur of 0.05
  const Surroundings table = surroundings_of(look);
  const auto red = [&](std::size_t i) { return static_cast<double>(table[i] & 2047) / 2047; };
  const auto blue = [&](std::size_t i) { return static_cast<double>(table[i] >> 22) / 1023; };
  EXPECT_NEAR(red(2048), 901 / 4096.0, 0.001);    // zenith
  EXPECT_NEAR(red(0), 1000 / 4096.0 / 4, 0.001);  // straight down: a quarter of the ground
  EXPECT_NEAR(blue(0), 3000 / 4096.0 / 4, 0.001);
  EXPECT_NEAR(blue(1024), (2250 + 3973) / 2.0 / 4096, 0.003);  // the horizon: half of both
}

// The glow is h^1.75, h^4.5 and h^8 with 2.3, 1.15 and 0.2.
TEST(Tables, GlowIsThatOfDouble) {
  const Glow table = glow_table();
  for (std::size_t i = 0; i < 256; ++i) {
    const double h = static_cast<double>(i) / 255;
    EXPECT_NEAR(table.light[i][0], 4096 * 2.3 * std::pow(h, 1.75), 8) << i;
    EXPECT_NEAR(table.light[i][1], 4096 * 1.15 * std::pow(h, 4.5), 4) << i;
    EXPECT_NEAR(table.light[i][2], 4096 * 0.2 * std::pow(h, 8), 3) << i;
  }
  EXPECT_EQ(table.crust[0], (Color{139, 119, 115}));
  EXPECT_EQ(table.crust[255], (Color{164, 57, 33}));
}

TEST(Tables, GlowNeverDarkensWithHeat) {
  const Glow table = glow_table();
  for (std::size_t i = 1; i < 256; ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_GE(table.light[i][c], table.light[i - 1][c]) << i;
}

// Black is tone 0, red 127 and white 255. An eighth of the way to the next one nothing changes: that is up to
// tone 15, where 4096 x 15 / 127 is 483. Tone 63 is 4096 x 63 / 127 = 2031 of the way. The share of red there
// has t = 4 (2031 - 512) / 3 = 2025, and is t^2 (12288 - 2 t) / 2^24 = 2013.
TEST(Tables, SolidsByTone) {
  Look look;
  EXPECT_FALSE(look.tinted());
  look.tints[1] = {4096, 0, 0};
  look.tints[2] = {4096, 4096, 4096};
  look.tint_count = 3;
  EXPECT_TRUE(look.tinted());
  for (const std::int32_t tone : {0, 15}) EXPECT_EQ(tint_at(look, tone), (Color{})) << tone;
  EXPECT_EQ(tint_at(look, 63), (Color{2013, 0, 0}));
  for (const std::int32_t tone : {112, 127, 142}) EXPECT_EQ(tint_at(look, tone), look.tints[1]) << tone;
  for (const std::int32_t tone : {239, 255}) EXPECT_EQ(tint_at(look, tone), look.tints[2]) << tone;

  look.metallic = 4096;  // a metal mirrors its colour, and scatters 614 / 4096 of it
  const Tints table = tint_table(look, 2000, {4096, 4096, 4096});
  EXPECT_EQ(table[127].diffuse, (Color{614, 0, 0}));
  EXPECT_EQ(table[127].mirror, (Color{4096, 0, 0}));
  EXPECT_EQ(table[127].highlight, (Color{2000, 0, 0}));
  EXPECT_EQ(table[255].highlight, (Color{2000, 2000, 2000}));
  EXPECT_EQ(table[0].gloss, table[255].gloss);
}

// The mean tone of 1000 with 250 is 250 x 256 / 1000 = 64. Rounding alone may leave more tone than solid.
TEST(Matter, ToneIsThatOfTheSolid) {
  Look look;
  EXPECT_EQ(matter_of(1000, 0, 250, 0, look).heat, 0);
  look.tint_count = 2;
  EXPECT_EQ(matter_of(1000, 0, 250, 0, look).heat, 64);
  EXPECT_EQ(matter_of(1000, 5000, 250, 0, look).heat, 64);
  EXPECT_EQ(matter_of(1, 0, 3, 0, look).heat, 255);
  EXPECT_EQ(matter_of(0, 1000, 3, 0, look).heat, 0);
}

// Half liquid, which is l = 16 x 128 + 8 = 2056, white becomes 4096 - 4096 x 2056 / 4096.
TEST(Shade, SolidsHaveTheMaterialOfTheirTone) {
  Look look;
  look.solid = {1, 2, 3};
  look.tints[1] = {4096, 4096, 4096};
  look.tint_count = 2;
  const Paint paint = paint_of(look, {{0, 1, 0}, 0});
  EXPECT_EQ(substance_of(paint, {0, 0, 0}, 0).material.diffuse, (Color{}));
  EXPECT_EQ(substance_of(paint, {0, 255, 0}, 0).material.diffuse, (Color{4096, 4096, 4096}));
  EXPECT_EQ(substance_of(paint, {128, 255, 0}, 0).material.diffuse, (Color{2040, 2040, 2040}));
  EXPECT_EQ(substance_of(paint, {0, 255, 0}, 0).emission, (Color{}));
  const Light light;
  const Color dark = inner_color(paint, light, {0, 0, 0}), bright = inner_color(paint, light, {0, 255, 0});
  EXPECT_EQ(dark, (Color{}));
  EXPECT_EQ(bright, inner_light(paint.lamp, paint.from_below, paint.from_above, light));
}

TEST(Tone, PressedLightIsThatOfDouble) {
  const Tone table = tone_table();
  for (std::int32_t i = 0; i <= kBrightest; ++i) {
    const double expected = i <= 2867 ? i : 2867 + 1229 * (1 - std::exp(-(i - 2867) / 1229.0));
    EXPECT_NEAR(table[static_cast<std::size_t>(i)], expected, 0.51) << i;
  }
}

TEST(Tone, BytesAreThoseOfDouble) {
  const Bytes table = byte_table();
  EXPECT_EQ(table[0], 0);
  EXPECT_EQ(table[4096], 255);
  for (std::int32_t i = 0; i <= 4096; ++i)
    EXPECT_EQ(table[static_cast<std::size_t>(i)], std::lround(srgb(i / 4096.0))) << i;
}

// Straight under the lamp, without ambient light, it is 1.2 of the lamp's colour. Half hidden, it is half of
// that.
TEST(Shade, LampAloneByHand) {
  Look look;
  const Paint paint = paint_of(look, {{0, 1 << 20, 0}, 0});
  EXPECT_EQ(paint.to_light, (Vector{0, 16384, 0}));
  Light light;
  const Color full = arriving(paint, {0, 16384, 0}, light, false);
  EXPECT_NEAR(full[0], 1.2 * 4342, 2);
  EXPECT_NEAR(full[1], 1.2 * 4096, 2);
  EXPECT_NEAR(full[2], 1.2 * 3768, 2);
  light.lamp = 127;
  EXPECT_NEAR(arriving(paint, {0, 16384, 0}, light, false)[1], 1.2 * 4096 * 127 / 256, 2);
  // From the side light bleeds around, by 0.15 of 1.15. From behind nothing arrives.
  light.lamp = 255;
  EXPECT_NEAR(arriving(paint, {16384, 0, 0}, light, false)[1], 1.2 * 4096 * 0.15 / 1.15, 2);
  EXPECT_EQ(arriving(paint, {0, -16384, 0}, light, false)[1], 0);
}

TEST(Shade, AmbientLightComesFromSkyAndGround) {
  Look look;
  look.ground = {1024, 2048, 4096};
  const Paint paint = paint_of(look, {{0, -(1 << 20), 0}, 4096});
  Light light;
  const Color up = arriving(paint, {0, 16384, 0}, light, false);
  EXPECT_EQ(up, (Color{3850, 4096, 4424}));
  const Color down = arriving(paint, {0, -16384, 0}, light, false);
  EXPECT_NEAR(down[0], 0.9 * 1024, 1);
  EXPECT_NEAR(down[2], 0.9 * 4096, 1);
  light.open = {255, 255, 127, 255, 255, 255};
  EXPECT_NEAR(arriving(paint, {0, 16384, 0}, light, false)[1], 4096 * 127 / 256.0, 1);
}

// A glow of 32 from below is 32 x 6144 / 32 in red.
TEST(Shade, GlowArrivesFromItsSide) {
  const Paint paint = paint_of({}, {{0, 1, 0}, 0});
  Light light;
  light.glow[3] = 32;
  EXPECT_EQ(arriving(paint, {0, -16384, 0}, light, true), (Color{6144, 1966, 369}));
  EXPECT_EQ(arriving(paint, {0, -16384, 0}, light, false), (Color{}));
}

TEST(Shade, ObstaclesHaveTheirOwnColour) {
  Look look;
  look.solid = {4096, 0, 0};
  look.liquid = {0, 4096, 0};
  look.ground = {0, 0, 2048};
  const Paint paint = paint_of(look, {{0, 1, 0}, 4096});
  const auto color = [&](Matter matter) {
    return matter_color(paint, {0, 16384, 0}, {0, 16384, 0}, Light{}, matter);
  };
  const Color solid = color({0, 0, 0}), liquid = color({255, 0, 0}), obstacle = color({0, 0, 255});
  EXPECT_GT(solid[0], 3500);
  EXPECT_LT(solid[1], 300);
  EXPECT_GT(liquid[1], 3500);
  EXPECT_LT(liquid[0], 300);
  EXPECT_NEAR(obstacle[2], 4424 * 2294 / 4096.0,
              100);                      // 2048 and 0.12 of the way to white, under the sky's blue
  EXPECT_EQ(color({0, 0, 148}), solid);  // this little of an obstacle does not show
}

TEST(Antialias, PlacesLieApartAndInTheMiddle) {
  const auto check = [](const auto& pattern) {
    std::int32_t across = 0, down = 0;
    for (const Sub& one : pattern) {
      across += one.across;
      down += one.down;
      for (const Sub& other : pattern)
        if (&one != &other) {
          EXPECT_NE(one.across, other.across);
          EXPECT_NE(one.down, other.down);
        }
    }
    EXPECT_EQ(across, 32 * static_cast<std::int32_t>(pattern.size()));
    EXPECT_EQ(down, 32 * static_cast<std::int32_t>(pattern.size()));
  };
  check(kMiddle);
  check(kEight);
  check(kThirtyTwo);
  EXPECT_FALSE(differ({0, 10, 255}, {8, 2, 247}, 8));
  EXPECT_TRUE(differ({0, 10, 255}, {0, 10, 246}, 8));
}

}  // namespace
}  // namespace voxmelt::picture
