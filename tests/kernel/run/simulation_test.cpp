// The run loop is repeatable, runs its phases in order, and melts and looks for visibility at the right step.
#include "kernel/run/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::run {
namespace {

using namespace worlds;
using rule::Law;
using step::Phase;

Parameters hot_parameters(Law law) {
  Parameters p = law == Law::paper ? paper_showcase() : viscous(0.05, 0.002);
  p.heat.enabled = true;
  p.heat.weight_face = 8000;
  p.heat.radiation = true;
  p.heat.sources = {{{{0, {16 * 20, 16 * 12, 16 * 8}, std::uint64_t{1} << 31}}}};
  return p;
}
Volume block() {
  Volume v(Grid{16, 12, 16});
  for_each({5, 2, 5, 11, 10, 11}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 25000); });
  return v;
}

TEST(Simulation, ARunRepeats) {
  for (const Law law : {Law::paper, Law::viscous}) {
    std::vector<std::uint64_t> digests;
    for (int repeat = 0; repeat < 2; ++repeat) {
      Simulation s = simulate(hot_parameters(law), block());
      for (std::size_t i = 0; i < 60; ++i) {
        s.step();
        const std::uint64_t d = state::digest(s.volume());
        if (repeat == 0) digests.push_back(d);
        ASSERT_EQ(d, digests[i]) << "step " << i;
      }
      EXPECT_GT(s.volume().liquid.count(), 20) << "it did melt";
    }
  }
}

// Dither, random bits, sources and vents go by the automaton's step number, not by the steps of this run.
TEST(Simulation, ARunThatBeginsInTheMiddleGoesOnTheSame) {
  for (const Law law : {Law::paper, Law::viscous})
    for (const step::Implementation& implementation : implementations().all()) {
      if (!implementation.supported) continue;
      Parameters p = hot_parameters(law);
      p.heat.sources = {{{{0, {16 * 20, 16 * 12, 16 * 8}, std::uint64_t{1} << 31},
                          {60, {-16 * 20, 16 * 12, 16 * 8}, std::uint64_t{1} << 33}}}};
      Simulation through(p, block(), implementation);
      for (int i = 0; i < 40; ++i) through.step();  // up to a step of visibility
      Simulation from_there(p, through.volume(), implementation);
      from_there.begin_at(40);
      const Volume middle = through.volume();
      for (int i = 0; i < 12; ++i) {
        through.step();
        from_there.step();
      }
      EXPECT_EQ(from_there.step_number(), 52u);
      EXPECT_TRUE(from_there.volume() == through.volume()) << implementation.name;
      EXPECT_GT(through.volume().liquid.count(), 0) << "nothing flows";
      Simulation as_if_new(p, middle, implementation);
      for (int i = 0; i < 12; ++i) as_if_new.step();
      EXPECT_FALSE(as_if_new.volume() == through.volume()) << "the step numbers do not matter";
    }
}

TEST(Simulation, TheSeedChangesThePaperLawOnly) {
  for (const Law law : {Law::paper, Law::viscous}) {
    Parameters p = hot_parameters(law);
    Simulation one = simulate(p, block());
    p.seed = 2;
    Simulation two = simulate(p, block());
    steps(one, 60);
    steps(two, 60);
    EXPECT_EQ(state::digest(one.volume()) == state::digest(two.volume()), law == Law::viscous);
  }
}

// Records the calls of its functions.
class Recorder final : public step::HostStepper {
 public:
  void change_sources(const Parameters&) override {}
  void run(Phase phase, step::Moment moment, const step::Irradiance* irradiance, Volume&,
           state::Ledger&) override {
    calls.push_back({phase, moment.step, moment.substep, moment.substeps,
                     irradiance == nullptr ? -1 : *irradiance->data(), moment.stages});
  }
  struct Call {
    Phase phase;
    std::uint32_t step;
    int substep, substeps, irradiance, stages;
  };
  static inline std::vector<Call> calls;
};
std::unique_ptr<step::Stepper> create_recorder(const Parameters&, Grid, const step::Tuning&) {
  Recorder::calls.clear();
  return std::make_unique<Recorder>();
}
const step::Implementation kRecorder{"recorder", "", create_recorder};

class Counter final : public visibility::Provider {
 public:
  std::int64_t irradiance(const Volume& v, const rule::Heat&, std::uint32_t step,
                          step::Irradiance& result) override {
    result[v.at(0, 0, 0)] = static_cast<std::uint16_t>(1000 + step);
    return 3;
  }
};

TEST(Simulation, PhasesInTheOrderOfThePage) {
  using enum Phase;
  for (const Law law : {Law::paper, Law::viscous}) {
    Parameters p;
    p.flow.law = law;
    Simulation s(p, Volume(Grid{1, 1, 1}), kRecorder);
    steps(s, 2);
    const std::array<Phase, 6> order = law == Law::paper
                                           ? std::array{source, heat, melt, gravity, spread, excess}
                                           : std::array{source, heat, melt, excess, spread, gravity};
    ASSERT_EQ(Recorder::calls.size(), 12u);
    for (std::size_t i = 0; i < 12; ++i) {
      EXPECT_EQ(Recorder::calls[i].phase, order[i % 6]);
      EXPECT_EQ(Recorder::calls[i].step, i / 6);
      EXPECT_EQ(Recorder::calls[i].irradiance, -1) << "no radiation, no irradiance";
    }
    EXPECT_EQ(s.steps_done(), 2u);
  }
}

TEST(Simulation, SubstepsSettleAndSpreadAndFallOnce) {
  using enum Phase;
  Parameters p;
  p.flow.law = Law::viscous;
  p.flow.viscous.substeps = 3;
  Simulation s(p, Volume(Grid{1, 1, 1}), kRecorder);
  steps(s, 2);
  const std::array<Phase, 10> order{source, heat,   melt,   excess, spread,
                                    excess, spread, excess, spread, gravity};
  ASSERT_EQ(Recorder::calls.size(), 20u);
  for (std::size_t i = 0; i < 20; ++i) {
    const auto& [phase, step, substep, substeps, irradiance, stages] = Recorder::calls[i];
    EXPECT_EQ(phase, order[i % 10]);
    EXPECT_EQ(step, i / 10);
    EXPECT_EQ(substeps, 3);
    EXPECT_EQ(stages, 1);
    if (phase == excess || phase == spread) {
      EXPECT_EQ(substep, static_cast<int>(i % 10 - 3) / 2);
    }
  }
}

// The columns have 1, 2 and 3 cells. Mobility 2/9 x 0.1 x M^2 against 1/5 / (M + 1) gives 0.22, 1.33 and 4.
TEST(Simulation, CountsTheSubstepsThatItsDeepestColumnNeeds) {
  Parameters p = viscous(0.1);
  p.flow.viscous.substeps = 0;
  for (const auto& [deepest, most, needed] :
       {std::array{1, 1024, 1}, {2, 1024, 2}, {3, 1024, 5}, {3, 2, 2}}) {
    p.flow.viscous.substeps_max = static_cast<std::uint16_t>(most);
    Volume v(Grid{4, 5, 1});
    for (int x = 0; x < 3; ++x) fill(v, {x, 0, 0, x + 1, std::min(x + 1, deepest), 1}, kOne);
    Simulation s(p, v, kRecorder);
    s.step();
    EXPECT_EQ(s.substeps(), needed) << deepest;
  }
}

// The deepest column needs 5 sub-steps. K of them leave S stages to do, with S (S + 1) / 2 >= 5 / K.
TEST(Simulation, CountsTheStagesThatSubstepsLeave) {
  Parameters p = viscous(0.1);
  Volume v(Grid{4, 5, 1});
  fill(v, {0, 0, 0, 1, 3, 1}, kOne);
  struct Row {
    std::uint16_t substeps, substeps_max, stages_max;
    int stages;
  };
  for (const Row& row : {Row{0, 1, 16, 3}, Row{0, 2, 16, 2}, Row{0, 4, 16, 2}, Row{0, 5, 16, 1},
                         Row{0, 1, 2, 2}, Row{0, 1, 1, 1}, Row{1, 9, 16, 3}, Row{3, 9, 16, 2}}) {
    p.flow.viscous.substeps = row.substeps;
    p.flow.viscous.substeps_max = row.substeps_max;
    p.flow.viscous.stages_max = row.stages_max;
    Simulation s(p, v, kRecorder);
    s.step();
    EXPECT_EQ(Recorder::calls.back().stages, row.stages) << row.substeps << " " << row.substeps_max;
  }
}

TEST(Simulation, VisibilityIsKeptBetweenItsSteps) {
  Parameters p;
  p.heat.enabled = p.heat.radiation = true;
  p.heat.visibility_every = 3;
  Simulation s(p, Volume(Grid{1, 1, 1}), kRecorder, step::Tuning{}, std::make_unique<Counter>());
  steps(s, 7);
  for (const Recorder::Call& call : Recorder::calls)
    EXPECT_EQ(call.irradiance, static_cast<int>(1000 + call.step / 3 * 3)) << "step " << call.step;
  EXPECT_EQ(s.irradiance_capped(), 3 * 3) << "three steps of visibility, with three cuts each";
}

// Rays end at places of a lamp that the seed of the run chooses (docs/automaton.md, section 5).
TEST(Simulation, RaysToALampGoByTheSeedOfTheRun) {
  Parameters p = hot_parameters(Law::paper);
  p.heat.sources = {{{{.at = {16 * 20, 16 * 14, 16 * 8}, .power = std::uint64_t{1} << 31, .radius = 60}},
                     rule::SourceKind::sphere}};
  p.heat.rays_per_face = 4;
  p.seed = 77;
  Simulation s = simulate(p, block());
  s.begin_step();
  const auto cast_with = [&](std::uint64_t seed) {
    rule::Heat heat = p.heat;
    heat.ray_seed = seed;
    step::Irradiance light(s.volume().grid);
    visibility::VoxelWalkProvider().irradiance(s.volume(), heat, 0, light);
    return light;
  };
  EXPECT_TRUE(*s.irradiance() == cast_with(77));
  EXPECT_FALSE(*s.irradiance() == cast_with(1)) << "the seed does not matter";
}

// Cells that melted after the last step of visibility are not seen before the next one.
TEST(Simulation, ResumedBetweenStepsOfVisibilityItKeepsTheLight) {
  Parameters p = hot_parameters(Law::viscous);
  p.heat.visibility_every = 20;
  Simulation through = simulate(p, block());
  steps(through, 55);
  state::MidRun left = through.mid_run();
  left.irradiance = *through.irradiance();
  Simulation resumed = simulate(p, through.volume());
  resumed.begin_at(through.step_number() - left.steps_done);
  resumed.resume(std::move(left));
  Simulation anew = simulate(p, through.volume());
  through.begin_step();
  resumed.begin_step();
  anew.begin_step();
  EXPECT_TRUE(*resumed.irradiance() == *through.irradiance());
  EXPECT_FALSE(*anew.irradiance() == *through.irradiance()) << "nothing has melted: this shows nothing";
  EXPECT_EQ(resumed.casts().asked, through.casts().asked);
}

TEST(Melting, AtExactlyTheMeltingPoint) {
  for (const Law law : {Law::paper, Law::viscous})
    for (const int latent : {0, 1, 5000})
      for (const int below : {0, 1}) {
        Parameters p = law == Law::paper ? paper_showcase() : viscous(0.02);
        p.heat.enabled = true;
        p.material = {32768, static_cast<rule::Temperature>(latent)};
        Volume v(Grid{3, 3, 3});
        put_solid(v, 1, 0, 1, 3000, 32768 + latent - below);
        Simulation s = simulate(p, v);
        step_by_phase(s, [&](Phase phase) {
          if (phase != Phase::melt) return;
          EXPECT_EQ(s.volume().liquid.test(1, 0, 1), below == 0);
          EXPECT_EQ(s.volume().solid.test(1, 0, 1), below == 1);
          EXPECT_EQ(amount_at(s, 1, 0, 1), 3000);
          EXPECT_EQ(s.volume().energy[s.volume().at(1, 0, 1)], law == Law::paper && below == 0 ? 3000 : 0);
          EXPECT_EQ(s.volume().heat[s.volume().at(1, 0, 1)], 32768 + latent - below);
        });
      }
}

TEST(Melting, NeedsHeat) {
  Volume v(Grid{3, 3, 3});
  put_solid(v, 1, 1, 1);
  Parameters p = paper_showcase();
  p.material.melting_point = 0;
  Simulation s = simulate(p, v);
  steps(s, 5);
  EXPECT_TRUE(s.volume().solid.test(1, 1, 1)) << "heat is off";
  p.heat.enabled = true;
  Simulation warm = simulate(p, v);
  warm.step();
  EXPECT_FALSE(warm.volume().solid.test(1, 1, 1)) << "0 reaches 0";
}

TEST(Implementations, WidestIsTheLastThatTheProcessorHas) {
  step::Registry registry;
  for (const auto& [name, supported] :
       {std::pair("plain", true), {"narrow", true}, {"wide", true}, {"alien", false}})
    registry.add({name, "", nullptr, supported});
  EXPECT_EQ(registry.widest().name, "wide");
}

TEST(Implementations, AreFoundByNameAndReferenceIsFirst) {
  EXPECT_EQ(implementations().all().front().name, "reference");
  EXPECT_EQ(implementations().find("auto"), nullptr) << "that is for kernel/run/trial to say";
  EXPECT_TRUE(implementations().widest().supported);
  EXPECT_EQ(implementations().find("no such"), nullptr);
}

}  // namespace
}  // namespace voxmelt::run
