// A user changes sources, vents and drains between steps. Every implementation gives the bits of a scene that
// said so from the start, and nothing out of range passes.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "tests/library/scene_file.h"

namespace voxmelt {
namespace {

using Sources = SceneFile;

Options by(const std::string& implementation) {
  Options options;
  options.implementation = implementation;
  return options;
}

// Until step 5 all is as the file says. Then a vent pours, far away. Before step 9 the lamp moves, which
// takes effect at step 12. At 13 a drain takes the vent's place.
const std::vector<std::string> kSaid = {
    "heat_source=[{keyframes=[{step=8, at=[20, 11, 10], power=4}, {step=12, at=[1, 11, 10.5], power=9}]}]",
    "vent=[{at=[55, 8, 10], radius=2.5, rate=0.125, temperature=0.75, energy=0.5, from=5, until=13}]",
    "drain=[{at=[55, 3, 10], radius=3, rate=0.0625, from=13}]"};

void step_by_hand(Simulation& simulation) {
  if (simulation.steps_done() == 5) simulation.set_vents({{{55, 8, 10}, 2.5, 0.125, 0.75, 0.5}});
  if (simulation.steps_done() == 9) simulation.set_heat_sources({HeatSource::fixed({1, 11, 10.5}, 9)});
  if (simulation.steps_done() == 13) {
    simulation.set_vents({});
    simulation.set_drains({{{55, 3, 10}, 3, 0.0625}});
  }
  simulation.step();
}

TEST_F(Sources, ChangedByHandGiveTheBitsOfASceneThatSaidSo) {
  Options options = by("reference");
  options.overrides = kSaid;
  Simulation said(file, options);
  std::vector<std::uint64_t> expected;
  for (int step = 0; step < 60; ++step) {
    said.step();
    expected.push_back(said.digest());
  }
  const Ledgers books = said.ledgers();
  ASSERT_TRUE(books.balance());
  EXPECT_GT(said.state().liquid.count(), 0u);
  EXPECT_TRUE(books.mass.terms[0].value > 0 && books.mass.terms[1].value < 0)
      << "the vent or the drain is idle";

  int compared = 0;
  for (const Implementation& one : implementations()) {
    if (!one.supported) continue;
    Simulation by_hand(file, by(one.name));
    for (std::size_t step = 0; step < expected.size(); ++step) {
      step_by_hand(by_hand);
      ASSERT_EQ(by_hand.digest(), expected[step]) << one.name << ", step " << step;
    }
    EXPECT_TRUE(by_hand.ledgers().balance()) << one.name;
    const Ledgers mine = by_hand.ledgers();
    for (const auto& [theirs, ours] :
         {std::pair(&books.mass, &mine.mass), std::pair(&books.energy, &mine.energy),
          std::pair(&books.heat, &mine.heat)})
      for (std::size_t t = 0; t < theirs->terms.size(); ++t)
        EXPECT_EQ(to_string(ours->terms[t].value), to_string(theirs->terms[t].value))
            << theirs->terms[t].name;
    ++compared;
  }
  EXPECT_GT(compared, 1);
}

TEST_F(Sources, WhatIsReadBackIsWhatWasSetRounded) {
  Options options;
  options.overrides = kSaid;
  Simulation simulation(file, options);
  ASSERT_EQ(simulation.heat_sources().size(), 1u);
  const std::vector<Keyframe> keys = simulation.heat_sources()[0].keyframes;
  ASSERT_EQ(keys.size(), 2u);
  EXPECT_EQ(keys[1].step, 12u);
  EXPECT_EQ(keys[1].at, (Position{1, 11, 10.5}));
  EXPECT_EQ(keys[1].power, 9);
  ASSERT_EQ(simulation.vents().size(), 1u);
  Vent vent = simulation.vents()[0];
  EXPECT_EQ(vent.at, (Position{55, 8, 10}));
  EXPECT_EQ(vent.radius, 2.5);
  EXPECT_EQ(vent.rate, 0.125);
  EXPECT_NEAR(vent.temperature, 0.75, 1e-5);
  EXPECT_EQ(vent.energy, 0.5);
  EXPECT_EQ(vent.from, 5u);
  EXPECT_EQ(vent.until, 13u);
  ASSERT_EQ(simulation.drains().size(), 1u);
  EXPECT_EQ(simulation.drains()[0].rate, 0.0625);
  EXPECT_EQ(simulation.drains()[0].until, kNever);

  vent.at = {1.03, 2, 3};  // 16.48 sixteenths
  simulation.set_vents({vent});
  EXPECT_EQ(simulation.vents()[0].at[0], 1.0);

  // Setting the numbers that were read changes nothing.
  Simulation untouched(file, options);
  Simulation same(file, options);
  for (int step = 0; step < 20; ++step) {
    same.set_heat_sources(same.heat_sources());
    same.set_vents(same.vents());
    same.set_drains(same.drains());
    same.step();
    untouched.step();
    ASSERT_EQ(same.digest(), untouched.digest()) << step;
  }
}

TEST_F(Sources, OfEveryKindAreReadBack) {
  using enum HeatSourceKind;
  Simulation simulation(file);
  simulation.set_heat_sources(
      {{{{.step = 2, .at = {1, 2, 3}, .power = 4, .radius = 2.03}}, sphere},
       {{{.power = 0.25, .direction = {0, 3, -1}}, {.step = 7, .power = 1, .direction = {1, 1, 1}}},
        directional},
       {{{.power = 0.125}}, sky}});
  for (int round = 0; round < 2; ++round) {  // rounded numbers stay as they are
    const std::vector<HeatSource> read = simulation.heat_sources();
    ASSERT_EQ(read.size(), 3u);
    EXPECT_EQ(read[0].kind, sphere);
    EXPECT_EQ(read[0].keyframes[0].radius, 2);
    EXPECT_EQ(read[0].keyframes[0].at, (Position{1, 2, 3}));
    EXPECT_EQ(read[1].kind, directional);
    EXPECT_EQ(read[1].keyframes[0].direction, (Position{0, 1, -10923.0 / 32768}));
    EXPECT_EQ(read[1].keyframes[1].direction, (Position{1, 1, 1}));
    EXPECT_EQ(read[2].kind, sky);
    EXPECT_EQ(read[2].keyframes[0].power, 0.125);
    simulation.set_heat_sources(read);
  }
}

TEST_F(Sources, WhatASceneMayNotSayIsRefusedAndNothingChanges) {
  Simulation simulation(file);
  simulation.set_vents({{{55, 8, 10}, 2, 0.1}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  Vent good{{55, 8, 10}, 2, 0.25};
  const auto refused = [&](auto change) {
    Vent vent = good;
    change(vent);
    const std::string message = message_of<InputError>([&] { simulation.set_vents({good, vent}); });
    EXPECT_NE(message.find("set_vents: error: vent.1."), std::string::npos) << message;
    EXPECT_EQ(simulation.vents().size(), 1u) << message;
  };
  refused([&](Vent& v) { v.at[1] = 65537; });
  refused([&](Vent& v) { v.at[2] = nan; });
  refused([&](Vent& v) { v.radius = 0; });
  refused([&](Vent& v) { v.radius = 8193; });
  refused([&](Vent& v) { v.rate = 0; });
  refused([&](Vent& v) { v.rate = 1.01; });
  refused([&](Vent& v) { v.temperature = -0.1; });
  refused([&](Vent& v) { v.temperature = 1.1; });
  refused([&](Vent& v) { v.energy = 1.5; });
  refused([&](Vent& v) { v.energy = std::numeric_limits<double>::infinity(); });
  refused([&](Vent& v) { v.from = v.until = 7; });
  good.rate = 2;
  EXPECT_EQ(message_of<InputError>([&] { simulation.set_vents({good}); }),
            "set_vents: error: vent.0.rate = 2 exceeds 1, a full cell per cell and step");
  EXPECT_NE(message_of<InputError>([&] {
              simulation.set_drains({{{0, 0, 0}, -1, 0.1}});
            }).find("set_drains: error: drain.0.radius"),
            std::string::npos);

  const auto lamps = [&](std::vector<HeatSource> sources) {
    return message_of<InputError>([&] { simulation.set_heat_sources(sources); });
  };
  EXPECT_NE(lamps({HeatSource::fixed({0, 0, 0}, 4194304)}).find("heat_source.0.keyframes.0.power"),
            std::string::npos);
  EXPECT_NE(lamps({HeatSource::fixed({0, nan, 0}, 1)}), "nothing");
  EXPECT_NE(lamps({HeatSource::fixed({0, 0, 0}, -1)}), "nothing");
  EXPECT_NE(lamps({HeatSource{}}).find("is empty"), std::string::npos);
  using enum HeatSourceKind;
  EXPECT_NE(lamps({{{{.radius = 8193}}, sphere}}).find("heat_source.0.keyframes.0.radius"),
            std::string::npos);
  EXPECT_NE(lamps({{{{.power = 1}}, directional}}).find("has no length"), std::string::npos);
  EXPECT_NE(
      lamps({{{{.power = 1}}, static_cast<HeatSourceKind>(kHeatSourceKinds)}}).find("heat_source.0.kind"),
      std::string::npos);
  EXPECT_NE(lamps({HeatSource{{{4, {}, 1}, {4, {}, 2}}}}).find("must be after"), std::string::npos);
  EXPECT_EQ(simulation.heat_sources()[0].keyframes[0].power, 4);

  const auto cold =
      write("cold.toml", "[grid]\nsize = [4, 4, 4]\n[[liquid]]\nshape = \"box\"\nsize = [1, 1, 1]\n");
  Simulation without_heat(cold);
  EXPECT_NE(message_of<InputError>([&] {
              without_heat.set_heat_sources({HeatSource::fixed({0, 0, 0}, 1)});
            }).find("no [heat]"),
            std::string::npos);
  without_heat.set_heat_sources({});
  without_heat.step();
}

// A scene that had no source gets one, and its last one is taken away.
TEST_F(Sources, AreLitInADarkSceneAndPutOut) {
  const std::string dark =
      std::string(kSmallScene).substr(0, std::string(kSmallScene).find("[[heat_source]]"));
  const auto dark_file = write("dark.toml", dark);
  Options options = by("reference");
  options.overrides = {
      "heat_source=[{keyframes=[{step=8, at=[20, 11, 10], power=0}, {step=12, at=[20, 11, 10], power=4}, "
      "{step=20, at=[20, 11, 10], power=4}, {step=24, at=[20, 11, 10], power=0}]}]"};
  Simulation said(dark_file, options);
  std::vector<Simulation> all;
  for (const Implementation& one : implementations())
    if (one.supported) all.emplace_back(dark_file, by(one.name));
  for (int step = 0; step < 40; ++step) {
    said.step();
    for (Simulation& simulation : all) {
      if (step == 9) simulation.set_heat_sources({HeatSource::fixed({20, 11, 10}, 4)});
      if (step == 22) simulation.set_heat_sources({});
      simulation.step();
      ASSERT_EQ(simulation.digest(), said.digest()) << simulation.implementation() << ", step " << step;
    }
  }
  for (const auto& term : said.ledgers().heat.terms)
    if (term.name == std::string("radiated")) {
      EXPECT_GT(term.value, 0);
      return;
    }
  FAIL() << "no term of the ledger is named radiated";
}

}  // namespace
}  // namespace voxmelt
