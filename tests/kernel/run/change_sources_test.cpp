// Sources, vents and drains are changed between steps. The bits are those of a scene that said so from the
// start, by keyframes and by from and until. This holds for every implementation, with threads, asleep and
// awake.
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::run {
namespace {

using namespace worlds;
using rule::Law;

// Makes a block on a floor, and much sleeping air around it.
Volume room() {
  Volume v(Grid{130, 14, 20});
  for_each({0, 0, 0, 130, 1, 20}, [&](int x, int y, int z) { put_inert(v, x, y, z); });
  for_each({5, 1, 5, 11, 9, 11}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 25000); });
  return v;
}
Parameters quiet(Law law) {
  Parameters p = law == Law::paper ? paper_showcase() : worlds::viscous(0.05);
  p.heat.enabled = true;
  p.heat.weight_face = 8000;
  p.open_border = true;  // which no change of sources closes
  return p;
}

constexpr std::uint64_t kPower = std::uint64_t{3} << 26;
constexpr rule::Position kLamp{16 * 16, 16 * 12, 16 * 8}, kOther{16 * -3, 16 * 8, 16 * 8};

rule::Vent vent(std::uint32_t from, std::uint32_t until) {
  return {{{16 * 100, 16 * 10, 16 * 10}, 40}, 900, 40000, 4096, from, until};
}
rule::Drain drain(std::uint32_t from, std::uint32_t until) {
  return {{{16 * 100, 16 * 2, 16 * 10}, 70}, 3000, from, until};
}

// Changes the sources by hand. Before step 3 a vent opens. Before 13 a lamp is lit, which shines from 16 on,
// the next step of visibility. Before 21 the lamp moves (24) and a drain takes the vent's place. Before 37
// all is gone (40).
void change(Simulation& simulation) {
  const auto lamp = [](rule::Position at) { return rule::HeatSource{{{0, at, kPower}}}; };
  if (simulation.steps_done() == 3) simulation.change_sources({{}, {vent(0, 0xFFFFFFFFu)}, {}});
  if (simulation.steps_done() == 13) simulation.change_sources({{lamp(kLamp)}, {vent(0, 0xFFFFFFFFu)}, {}});
  if (simulation.steps_done() == 21) simulation.change_sources({{lamp(kOther)}, {}, {drain(0, 0xFFFFFFFFu)}});
  if (simulation.steps_done() == 37) simulation.change_sources({});
}

// A scene says the same. Visibility looks at keyframes at steps 0, 8, 16 .. only.
Parameters said_by_the_scene(Law law) {
  Parameters p = quiet(law);
  p.vents = {vent(3, 21)};
  p.drains = {drain(21, 37)};
  p.heat.radiation = true;
  p.heat.sources = {
      {{{8, kLamp, 0}, {16, kLamp, kPower}, {24, kOther, kPower}, {32, kOther, kPower}, {40, kOther, 0}}}};
  return p;
}

struct Way {
  std::string name;
  step::Tuning tuning;
};
std::vector<Way> ways() {
  std::vector<Way> all{{"reference", {}}};
  for (const std::string& name : fast_implementations())
    for (const int threads : {1, 3})
      for (const bool sleep : {true, false})
        all.push_back({name, {.threads = threads, .sleep = sleep, .tile_shift = 1}});
  return all;
}

TEST(ChangeSources, GivesTheBitsOfASceneThatSaidSo) {
  for (const Law law : {Law::paper, Law::viscous}) {
    std::vector<Volume> expected;
    std::vector<state::Ledger> books;
    Simulation said = simulate(said_by_the_scene(law), room());
    for (int step = 0; step < 56; ++step) {
      said.step();
      expected.push_back(said.volume());
      books.push_back(said.ledger());
    }
    EXPECT_GT(said.ledger().mass.added, 0);
    EXPECT_GT(said.ledger().mass.removed, 0);
    EXPECT_GT(said.ledger().heat.radiated, 0);
    EXPECT_LT(said.volume().solid.count(), room().solid.count()) << "the lamp melts nothing";
    EXPECT_GT(books[38].heat.radiated, books[37].heat.radiated) << "the lamp is dark too early";

    for (const Way& way : ways()) {
      Simulation by_hand(quiet(law), room(), implementation(way.name), way.tuning);
      for (std::size_t step = 0; step < expected.size(); ++step) {
        change(by_hand);
        by_hand.step();
        ASSERT_EQ(difference(expected[step], by_hand.volume()), "") << way.name << ", step " << step;
        ASSERT_TRUE(by_hand.ledger() == books[step]) << "the books differ: " << way.name << ", step " << step;
      }
      EXPECT_TRUE(by_hand.drift().none()) << way.name;
    }
  }
}

}  // namespace
}  // namespace voxmelt::run
