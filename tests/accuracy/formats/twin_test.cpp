// The twin in 16 bits with dither is the automaton, bit for bit. The other formats keep what they must keep,
// and small cases have the values that a hand computes.
#include "accuracy/formats/twin.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>

#include "kernel/scene/scene.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::accuracy::front {
namespace {

using namespace worlds;

void expect_engine_bits(const Parameters& parameters, const Volume& start, int steps,
                        const std::string& what) {
  run::Simulation engine(parameters, start, run::implementations().widest());
  const std::unique_ptr<Twin> twin = make_twin(kEngine, parameters, start);
  for (int s = 0; s < steps; ++s) {
    engine.step();
    twin->step();
  }
  const Volume found = twin->volume();
  ASSERT_TRUE(found == engine.volume()) << what;
}

TEST(Twin, DitheredSixteenBitsAreTheEnginesInHostileWorlds) {
  Random random(1612);
  for (int world = 0; world < 150; ++world) {
    const Grid grid{random.any({1, 2, 7, 20}), random.any({1, 2, 9, 17}), random.any({1, 3, 11})};
    Parameters parameters = hostile_parameters(random, rule::Law::paper, grid);
    parameters.flow.paper.reading = rule::EnergyReading::text;
    const Volume start = hostile_volume(random, parameters, grid);
    expect_engine_bits(parameters, start, 12, "world " + std::to_string(world));
    if (HasFatalFailure()) return;
  }
}

TEST(Twin, DitheredSixteenBitsAreTheEnginesInScenes) {
  for (const char* name :
       {"proving_ground", "bunny_small", "lesson_oven", "lesson_latent_heat", "lesson_drain"}) {
    const scene::Scene scene = scene::load(std::string(VOXMELT_SCENES_FOLDER "/") + name + ".toml", {});
    if (scene.parameters.flow.law != rule::Law::paper) continue;
    rule::Parameters parameters = scene.parameters;
    parameters.material.freezing_point = 0;  // a twin knows neither freezing nor glow
    parameters.heat.air_glow = 0;
    expect_engine_bits(parameters, scene.initial, 150, name);
  }
}

double mass(const Twin& twin) {
  double sum = 0;
  twin.for_each_matter([&](int, int, int, const Held& held) { sum += held.amount; });
  return sum;
}

// No format loses or makes liquid. Whole ones keep it to the unit, real ones to their last digits. E <= A
// holds.
TEST(Twin, EveryFormatKeepsMass) {
  Random random(77);
  for (int world = 0; world < 40; ++world) {
    const Grid grid{13, 11, 9};
    Parameters parameters = hostile_parameters(random, rule::Law::paper, grid);
    parameters.flow.paper.reading = rule::EnergyReading::text;
    parameters.vents.clear();
    parameters.drains.clear();
    parameters.open_border = false;
    const Volume start = hostile_volume(random, parameters, grid);
    for (const Arithmetic arithmetic : all_arithmetics()) {
      const std::unique_ptr<Twin> twin = make_twin(arithmetic, parameters, start);
      const double before = mass(*twin);
      for (int s = 0; s < 10; ++s) twin->step();
      const double unit = arithmetic.number == Number::f32 ? 1e-6 : is_real(arithmetic.number) ? 1e-13 : 0;
      EXPECT_NEAR(mass(*twin), before, unit * before) << name_of(arithmetic) << ", world " << world;
      twin->for_each_matter([&](int x, int y, int z, const Held& held) {
        ASSERT_LE(held.energy, held.amount) << name_of(arithmetic) << ' ' << x << ' ' << y << ' ' << z;
        ASSERT_TRUE(held.heat >= 0 && held.heat <= 1) << name_of(arithmetic) << ' ' << held.heat;
      });
    }
  }
}

// Two solid cells are 1,000 units apart at weight 5,000 / 65536, so the warm one loses 76.29 units. In 16
// bits that is 76, truncated or to the nearest. At 1,016 units it is 77.51: 77 truncated, 78 to the nearest.
// In 8 bits 1,024 units are 4 units of 256, and weight 10,000 moves 0.61 of one: none truncated, one to the
// nearest.
TEST(Twin, ConductionOfTwoCellsByHand) {
  const auto after = [](Arithmetic arithmetic, std::int32_t warm, std::uint16_t weight) {
    Volume v(Grid{2, 1, 1});
    put_solid(v, 0, 0, 0, kOne, 2048);
    put_solid(v, 1, 0, 0, kOne, 2048 + warm);
    Parameters p;
    p.heat.enabled = true;
    p.heat.weight_face = weight;
    p.material.melting_point = 65535;
    const std::unique_ptr<Twin> twin = make_twin(arithmetic, p, v);
    twin->step();
    double gain = 0;
    twin->for_each_matter([&](int x, int, int, const Held& held) {
      if (x == 0) gain = held.heat * 65536 - 2048;
    });
    return gain;
  };
  EXPECT_EQ(after({Number::u16, Rounding::truncate}, 1000, 5000), 76);
  EXPECT_EQ(after({Number::u16, Rounding::nearest}, 1000, 5000), 76);
  EXPECT_EQ(after({Number::u16, Rounding::truncate}, 1016, 5000), 77);  // 77.51
  EXPECT_EQ(after({Number::u16, Rounding::nearest}, 1016, 5000), 78);
  EXPECT_EQ(after({Number::u16, Rounding::truncate}, -1016, 5000), -77);  // towards 0
  EXPECT_EQ(after({Number::u8, Rounding::truncate}, 1024, 10000), 0);     // 4 units of 256: 0.61 of one
  EXPECT_EQ(after({Number::u8, Rounding::nearest}, 1024, 10000), 256);
  EXPECT_EQ(after({Number::u32, Rounding::truncate}, 1000, 5000), std::floor(1000. * 5000) / 65536);
  EXPECT_DOUBLE_EQ(after(kExact, 1000, 5000), 1000. * 5000 / 65536);
  EXPECT_NEAR(after({Number::f32, Rounding::truncate}, 1000, 5000), 1000. * 5000 / 65536, 1e-3);
}

// Over 256 steps the dither of one flow of 0.305 units gives it right on average. Truncation gives nothing.
TEST(Twin, DitherIsRightOnAverage) {
  const auto convected = [](Rounding rounding) {
    Volume v(Grid{1, 2, 1});
    put(v, 0, 0, 0, kOne, 0, 100);
    put(v, 0, 1, 0, kOne, 0, 0);
    Parameters p;
    p.heat.enabled = true;
    p.heat.convection = 200;  // 100 x 200 / 65536 = 0.305 at first
    p.material.melting_point = 65535;
    const std::unique_ptr<Twin> twin = make_twin({Number::u16, rounding}, p, v);
    for (int s = 0; s < 256; ++s) twin->step();
    return static_cast<int>(twin->volume().heat[v.at(0, 1, 0)]);
  };
  // The difference shrinks by 1 - 400 / 65536 a step: 50 (1 - that^256) = 39.5 have risen.
  EXPECT_NEAR(convected(Rounding::dithered), 39.5, 2);
  EXPECT_EQ(convected(Rounding::truncate), 0);
  EXPECT_EQ(convected(Rounding::nearest), 0);
}

// Every format takes over numbers of the 16-bit state.
TEST(Format, NumbersOfSixteenBits) {
  using Eight = Whole<std::uint8_t, Rounding::truncate>;
  using Wider = Whole<std::uint32_t, Rounding::dithered>;
  EXPECT_EQ(Eight::of(0), 0);
  EXPECT_EQ(Eight::of(1), 1);  // a number above 0 does not vanish
  EXPECT_EQ(Eight::of(4096), 16);
  EXPECT_EQ(Eight::of(4096 + 128), 17);
  EXPECT_EQ(Eight::of(65535), 255);
  EXPECT_EQ(Eight::in_units(16), 4096);
  EXPECT_EQ(Wider::of(4096), Wider::kOne);
  EXPECT_EQ(Wider::in_units(Wider::of(12345)), 12345);
  EXPECT_EQ(Wider::radiated(16, 0), 65536);                                       // one unit of 16 bits
  EXPECT_EQ((Whole<std::uint16_t, Rounding::truncate>::radiated(31, 65535)), 1);  // 1.94
  EXPECT_EQ((Whole<std::uint16_t, Rounding::nearest>::radiated(31, 0)), 2);
  EXPECT_EQ((Whole<std::uint16_t, Rounding::dithered>::radiated(17, 61439)), 1);  // 1.0625 + 0.9375 - 1/65536
  EXPECT_EQ((Whole<std::uint16_t, Rounding::dithered>::radiated(17, 61440)), 2);
  EXPECT_EQ(Eight::radiated(4096, 0), 1);
  EXPECT_EQ(Real<double>::radiated(8, 0), 0.5);
}

TEST(Format, Names) {
  EXPECT_EQ(all_arithmetics().size(), 11u);
  EXPECT_EQ(name_of(kEngine), "u16 dithered");
  EXPECT_EQ(name_of(kExact), "double");
  Parameters p;
  EXPECT_EQ(state_bits(Number::u16, p), 34);  // two masks, amount, energy
  p.heat.enabled = true;
  EXPECT_EQ(state_bits(Number::u16, p), 50);
  EXPECT_EQ(state_bits(Number::f64, p), 194);
}

TEST(Twin, RefusesWhatItDoesNotKnow) {
  Parameters p;
  p.flow.law = rule::Law::viscous;
  EXPECT_THROW(make_twin(kEngine, p, Volume(Grid{1, 1, 1})), std::invalid_argument);
}

}  // namespace
}  // namespace voxmelt::accuracy::front
