// The benchmark is tested: it refuses wrong results, its workloads do what they say, and its arithmetic is
// right.
#include "measure/measure.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/state/digest.h"
#include "kernel/engine/scalar/reference.h"
#include "kernel/run/simulation.h"
#include "measure/baseline_run.h"
#include "measure/machine.h"
#include "measure/needed.h"
#include "measure/roof.h"
#include "measure/suite.h"
#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

// Is the reference with one fault in one cell.
enum class Fault { amount, leak };
template <Fault fault>
class Faulty : public step::HostStepper {
 public:
  Faulty(const rule::Parameters& parameters, state::Grid grid) : sound_(parameters, grid) {}

  void change_sources(const rule::Parameters& parameters) override { sound_.change_sources(parameters); }
  void run(step::Phase phase, step::Moment step, const step::Irradiance* irradiance, state::Volume& volume,
           state::Ledger& ledger) override {
    sound_.run(phase, step, irradiance, volume, ledger);
    if (phase != step::Phase::spread || step.step != 1) return;
    if (fault == Fault::amount)
      ++volume.amount[volume.at(3, 3, 3)];
    else
      ++ledger.mass.added;
  }

 private:
  scalar::Reference sound_;
};

template <Fault fault>
step::Implementation faulty() {
  return {"faulty", "",
          [](const rule::Parameters& parameters, state::Grid grid,
             const step::Tuning&) -> std::unique_ptr<step::Stepper> {
            return std::make_unique<Faulty<fault>>(parameters, grid);
          }};
}

TEST(Measure, AWrongResultIsNotTimed) {
  const Workload workload = dense_paper(12, false);
  const step::Implementation wrong = faulty<Fault::amount>(), leaking = faulty<Fault::leak>();
  const step::Implementation& reference = run::implementations().all().front();
  EXPECT_NO_THROW(measure(workload, {{&reference, 1}}, {1, 0}, false));
  for (const step::Implementation* implementation : {&wrong, &leaking}) {
    try {
      measure(workload, {{&reference, 1}, {implementation, 1}}, {1, 0}, false);
      FAIL() << "the fault went unnoticed";
    } catch (const Mismatch& error) {
      EXPECT_NE(std::string(error.what()).find("faulty on dense:12"), std::string::npos) << error.what();
    }
  }
}

TEST(Measure, DenseVolumesAreInMotionAllTheTime) {
  for (const Workload& workload : {dense_paper(24, true), dense_viscous(24, true), dense_heat(24, 6)}) {
    run::Simulation simulation(workload.parameters, workload.start, run::implementations().all().front());
    for (int step = 0; step < workload.lead_steps + workload.steps; ++step) {
      const state::Volume before = simulation.volume();
      simulation.step();
      std::size_t changed = 0;
      for (std::size_t i = 0; i < before.amount.layout().cells(); ++i)
        changed += before.amount[{i}] != simulation.volume().amount[{i}] ||
                   before.heat[{i}] != simulation.volume().heat[{i}];
      EXPECT_GT(changed, before.grid.cells() * 9 / 10) << workload.name << ", step " << step;
    }
    const std::int64_t cells = static_cast<std::int64_t>(workload.start.grid.cells());
    EXPECT_EQ(active_cells(workload, true), cells);
    if (workload.times_flow) {
      EXPECT_GT(simulation.volume().liquid.count(), cells * 9 / 10) << workload.name;
    }
  }
}

TEST(Measure, WhatSleepsStaysAsItIs) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    const Workload workload = asleep({16, 16, 16}, 8, law);
    EXPECT_EQ(expected_digest(workload), state::digest(workload.start));
  }
}

TEST(Measure, SourcesKeepTheirTimes) {
  rule::Parameters p;
  p.vents.push_back({.region = {}, .rate = 1, .from = 100, .until = 300});
  p.vents.push_back({.region = {}, .rate = 1});
  p.heat.sources.push_back({{{0, {1, 0, 0}, 5}, {150, {2, 0, 0}, 6}, {400, {3, 0, 0}, 7}}});
  const rule::Parameters q = later(p, 200);
  EXPECT_EQ(q.vents[0].from, 0u);
  EXPECT_EQ(q.vents[0].until, 100u);
  EXPECT_EQ(q.vents[1].until, 0xFFFFFFFFu);
  ASSERT_EQ(q.heat.sources[0].keys.size(), 2u);
  EXPECT_EQ(q.heat.sources[0].keys[0].power, 6u);
  EXPECT_EQ(q.heat.sources[0].keys[1].step, 200u);
}

TEST(Measure, WorkIsTheSumOfItsParts) {
  for (const Workload& workload : {dense_paper(4, false), dense_paper(4, true), dense_viscous(4, true)}) {
    const Work flow = work_of(Subject::flow, workload.parameters);
    const Work gravity = work_of(Subject::gravity, workload.parameters);
    const Work spread = work_of(Subject::spread, workload.parameters);
    EXPECT_DOUBLE_EQ(flow.operations(), gravity.operations() + spread.operations());
    EXPECT_DOUBLE_EQ(flow.bytes, spread.bytes) << "one fused pass";
    double sum = 0;
    for (const Count& count : flow.counts) sum += count.multiplies + count.others;
    EXPECT_DOUBLE_EQ(flow.operations(), sum);
  }
  EXPECT_DOUBLE_EQ(work_of(Subject::flow, dense_paper(4, false).parameters).bytes, 8.5);
  EXPECT_DOUBLE_EQ(work_of(Subject::flow, dense_paper(4, true).parameters).bytes, 12.5);
}

TEST(Measure, TheRoofIsTheLowestOfThreeLimits) {
  Work work;
  work.multiplies = 10;
  work.others = 30;
  work.bytes = 8;
  EXPECT_DOUBLE_EQ(roof_of(work, {1000, 8000}, {1e6, 0}).cells(), 100);
  EXPECT_DOUBLE_EQ(roof_of(work, {8000, 2000}, {1e6, 0}).cells(), 50);
  EXPECT_DOUBLE_EQ(roof_of(work, {8000, 8000}, {160, 80}).cells(), 20);
  EXPECT_DOUBLE_EQ(roof_of(work, {1000, 8000}, {1e6, 0}).multiplies, 25) << "40 operations, each a multiply";
}

Seconds seconds(double gravity, double spread) {
  Seconds result;
  result.phase[static_cast<std::size_t>(step::Phase::gravity)] = gravity;
  result.phase[static_cast<std::size_t>(step::Phase::spread)] = spread;
  return result;
}

// There are two steps and three rounds, each disturbed somewhere else. Gravity is (2 + 3) / 2, and spread is
// (10 + 30) / 2.
TEST(Measure, EachPhaseOfEachStepCountsWithItsLeastTime) {
  Fastest fastest;
  fastest.add({seconds(9, 10), seconds(3, 90)});
  fastest.add({seconds(2, 50), seconds(7, 30)});
  fastest.add({seconds(4, 11), seconds(5, 31)});
  EXPECT_EQ(fastest.rounds(), 3);
  EXPECT_DOUBLE_EQ(fastest.step().flow(), 2.5 + 20);
  EXPECT_DOUBLE_EQ(fastest.step().phase[static_cast<std::size_t>(step::Phase::gravity)], 2.5);
  EXPECT_DOUBLE_EQ(fastest.step().heat(), 0);
  // The rounds' mean steps are (19 + 93) / 2, (52 + 37) / 2 and (15 + 36) / 2.
  EXPECT_DOUBLE_EQ(fastest.median().flow, 44.5);
  EXPECT_DOUBLE_EQ(fastest.median().heat, 0);
}

TEST(Measure, RoundsEndByNumberAndByTime) {
  const RoundClock hasty({.fewest = 3, .seconds = 0}), patient({.fewest = 3, .seconds = 1e9});
  EXPECT_TRUE(hasty.more(2));
  EXPECT_FALSE(hasty.more(3));
  EXPECT_TRUE(patient.more(39));
  EXPECT_FALSE(patient.more(40));
}

TEST(Measure, ARatioSaysHowManyTimesAsLongTheBaselineTakes) {
  EXPECT_DOUBLE_EQ(*ratio_to(seconds(6, 18), seconds(1, 2), Subject::flow), 8);
  EXPECT_FALSE(ratio_to(std::nullopt, seconds(1, 2), Subject::flow));
}

// The case takes 6 ms on one thread, 4 ms on two, 1.2 ms on eight: 1.5 and 5 times as fast.
TEST(Measure, SpeedUpsAreAgainstTheSameCaseOnOneThread) {
  std::vector<Case> cases;
  const auto add = [&](const char* workload, const char* implementation, Subject subject, int threads,
                       double seconds) {
    Case& one = cases.emplace_back();
    one.workload = workload;
    one.implementation = implementation;
    one.subject = subject;
    one.threads = threads;
    one.seconds = seconds;
  };
  add("dense:128", "avx2", Subject::flow, 1, 6e-3);
  add("dense:128", "avx2", Subject::flow, 2, 4e-3);
  add("dense:128", "avx2", Subject::flow, 8, 1.2e-3);
  add("dense:128", "avx2", Subject::heat, 1, 1e-3);
  add("dense:128", "sse4.2", Subject::flow, 1, 9e-3);
  add("dense:256", "avx2", Subject::flow, 1, 50e-3);
  add("scene:cello", "avx2", Subject::flow, 1, 1e-3);
  add("scene:cello", "avx2", Subject::flow, 2, 1e-3);
  const std::vector<Scaling> scaling = scaling_of(cases);
  ASSERT_EQ(scaling.size(), 2U);
  EXPECT_EQ(scaling[0].threads, 2);
  EXPECT_DOUBLE_EQ(scaling[0].speedup, 1.5);
  EXPECT_DOUBLE_EQ(scaling[0].efficiency(), 0.75);
  EXPECT_EQ(scaling[1].threads, 8);
  EXPECT_DOUBLE_EQ(scaling[1].speedup, 5);
  EXPECT_DOUBLE_EQ(scaling[1].efficiency(), 0.625);
}

TEST(Measure, ARunTimesEachOfItsSteps) {
  const Workload workload = dense_viscous(24, false);
  const std::uint64_t expected = expected_digest(workload);
  const auto start = std::chrono::steady_clock::now();
  const Steps steps = timed_run(workload, {&run::implementations().all().front(), 1}, expected);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  ASSERT_EQ(steps.size(), 4U);
  double sum = 0;
  for (const Seconds& step : steps) {
    EXPECT_GT(step.flow(), 0);
    sum += step.total();
  }
  EXPECT_LE(sum, wall.count()) << "steps hold the time of those before them";
}

TEST(Measure, TheBaselineTimesTheSameSteps) {
  const Workload workload = dense_heat(8, 6);
  const Steps steps = BaselineRuns::of(workload)->plain();
  ASSERT_EQ(steps.size(), 4U);
  for (const Seconds& step : steps) {
    EXPECT_GT(step.heat(), 0);
    EXPECT_GT(step.flow(), 0);
  }
  const Result result = measure(workload, {{&run::implementations().all().front(), 1}}, {2, 0}, true);
  EXPECT_EQ(result.rounds, 2);
  ASSERT_TRUE(result.plain);
  EXPECT_GT(result.plain->heat(), 0);
}

TEST(Measure, ThreeDigits) {
  EXPECT_EQ(three_digits(0.01234), "0.012");
  EXPECT_EQ(three_digits(1.234), "1.23");
  EXPECT_EQ(three_digits(99.99), "100");
  EXPECT_EQ(or_dash(std::nullopt), "–");
}

// The page shows the widest instruction set on all threads, which is the last of these four cases.
TEST(Measure, ThePageShowsTheWidestSetOnAllThreads) {
  Findings findings;
  double seconds = 0.008;
  for (const char* implementation : {"sse4.2", "avx2"})
    for (const int threads : {1, 2}) {
      Case& one = findings.cases.emplace_back();
      one.workload = "scene:cello/step:1050";
      one.implementation = implementation;
      one.threads = threads;
      one.cells = 1'500'000;
      one.active = 30'000;
      one.seconds = seconds /= 2;  // the last: 0.5 ms
      one.ratio_to_baseline = 12;
    }
  const std::string text = short_tables(findings);
  EXPECT_NE(text.find("Instruction set avx2, 2 threads."), std::string::npos) << text;
  EXPECT_NE(text.find("| `cello/step:1050` | 1.50 | 2.0 % | 0.500 | 12.0 | – | – |"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("1.00 |"), std::string::npos) << "another set or fewer threads\n" << text;
}

// One cell of liquid hangs in the air, 17 cells from the wall. It falls each step, and changes two vectors,
// above and below. A vector holds 8, 16 or 32 cells, and there are no others that change.
TEST(Needed, AFallingCellChangesTwoVectors) {
  Workload workload;
  workload.start = state::Volume(state::Grid{40, 12, 3});
  workload.start.amount[workload.start.at(17, 10, 1)] = rule::kOne;
  workload.start.liquid.set(17, 10, 1, true);
  workload.lead_steps = 1;
  workload.steps = 3;
  for (const Needed& needed : needed_vectors(workload, {8, 16, 32})) {
    EXPECT_DOUBLE_EQ(needed.gravity, 2);
    EXPECT_DOUBLE_EQ(needed.heat, 0);
  }
}

// A row of 33 cells falls as one. It lies in five vectors of 8, three of 16, two of 32, each in two rows.
TEST(Needed, VectorsAreThoseOfTheInstructionSet) {
  Workload workload;
  workload.start = state::Volume(state::Grid{33, 8, 1});
  for (int x = 0; x < 33; ++x) {
    workload.start.amount[workload.start.at(x, 6, 0)] = rule::kOne;
    workload.start.liquid.set(x, 6, 0, true);
  }
  workload.lead_steps = 0;
  workload.steps = 2;
  const std::vector<Needed> needed = needed_vectors(workload, {8, 16, 32});
  EXPECT_DOUBLE_EQ(needed[0].gravity, 10);
  EXPECT_DOUBLE_EQ(needed[1].gravity, 6);
  EXPECT_DOUBLE_EQ(needed[2].gravity, 4);
}

// Two solid cells lie side by side, cold and warm: their heats change, and nothing else does. Cells 7 and 8
// lie in two vectors of 8, and in one of 16.
TEST(Needed, HeatAloneCountsAsAChange) {
  Workload workload;
  workload.parameters.heat.enabled = true;
  workload.parameters.heat.weight_face = 2086;
  workload.parameters.material.melting_point = 50000;
  workload.start = state::Volume(state::Grid{32, 2, 2});
  for (const int x : {7, 8}) {
    workload.start.amount[workload.start.at(x, 0, 0)] = rule::kOne;
    workload.start.heat[workload.start.at(x, 0, 0)] = static_cast<std::uint16_t>(x == 7 ? 1000 : 20000);
    workload.start.solid.set(x, 0, 0, true);
  }
  workload.lead_steps = 0;
  workload.steps = 1;
  const std::vector<Needed> needed = needed_vectors(workload, {8, 16});
  EXPECT_DOUBLE_EQ(needed[0].heat, 2);
  EXPECT_DOUBLE_EQ(needed[1].heat, 1);
  EXPECT_DOUBLE_EQ(needed[0].gravity + needed[0].spread, 0);
}

// There are 100 vectors of gravity and 50 of spread, of 16 cells, on two threads. A full volume of 1000 cells
// takes 2 and 6 ms: (1600 x 2 us + 800 x 6 us) / 2. Heat has 10 x 16 cells at 5 us, halved.
TEST(Needed, TheLeastTimeIsThatOfFullVectors) {
  Seconds solid;
  solid.phase[static_cast<std::size_t>(step::Phase::heat)] = 4e-3;
  solid.phase[static_cast<std::size_t>(step::Phase::melt)] = 1e-3;
  const LeastSeconds least =
      least_seconds({100, 50, 10}, 16, 2, {seconds(2e-3, 6e-3), 1000}, FullVolume{solid, 1000});
  EXPECT_DOUBLE_EQ(least.flow, 4e-3);
  EXPECT_DOUBLE_EQ(*least.heat, 0.4e-3);
}

// Only the full volume with heat, by the same set on one thread, bounds a scene with heat.
TEST(Needed, AScenesBoundIsThatOfItsSet) {
  std::vector<Case> cases;
  const auto add = [&](const char* workload, const char* set, int threads, double spread) -> Case& {
    Case& one = cases.emplace_back();
    one.workload = workload;
    one.implementation = set;
    one.threads = threads;
    one.cells = 1 << 18;
    one.step = seconds(0, spread);
    one.seconds = spread;
    one.hot = true;
    return one;
  };
  const std::string first(cpu::kInstructionSets.front().name);
  const double per_cell = 1e-9 * (1 << 18);
  add("dense:64/law:paper/heat:off", first.c_str(), 1, 1 * per_cell);
  add("dense:64/law:paper/heat:on", first.c_str(), 1, 3 * per_cell);
  add("dense:64/law:paper/heat:on", first.c_str(), 2, 2 * per_cell);
  add("dense:64/law:paper/heat:on", "reference", 1, 100 * per_cell);
  Case& scene = add("scene:cello/step:1050", first.c_str(), 2, 1e-3);
  scene.needed = Needed{0, 1000, 0};
  scene.ratio_to_baseline = 20;
  bound_scenes(cases);
  // The scene has 1000 vectors of 8 cells at 3 ns, on two threads.
  ASSERT_TRUE(cases.back().least_seconds);
  EXPECT_DOUBLE_EQ(*cases.back().least_seconds, 12e-6);
  EXPECT_DOUBLE_EQ(*cases.back().least_ratio_to_baseline(), 20 * 1e-3 / 12e-6);
  EXPECT_FALSE(cases.front().least_seconds);
}

// Two processors, of which this program may have taken two: a quarter of them is half a thread.
TEST(Texts, OtherWorkIsSaidFromAQuarterOfTheProcessorsOn) {
  EXPECT_EQ(busy_text(0.49, 0, 2), "");
  EXPECT_EQ(busy_text(2.49, 2, 2), "");
  EXPECT_EQ(busy_text(12.1, 0, 2),
            "the load average is 12.1 on 2 processors: other programs take processors, and times and ratios "
            "may be far off");
  EXPECT_NE(busy_text(0.3, 0, 1).find("on 1 processor:"), std::string::npos);
  EXPECT_NE(busy_text(2.5, 2, 2), "");
}

TEST(Machine, MoreThreadsAreNeverAWorseBound) {
  Machine machine({.fewest = 2, .seconds = 0});
  const Bandwidth one = machine.bandwidth(1 << 20, 1), two = machine.bandwidth(1 << 20, 2);
  EXPECT_GT(one.copy, 1e8);
  EXPECT_GE(two.copy, one.copy);
  const LaneRates rates = machine.lane_rates(cpu::kInstructionSets.front().set, 1);
  EXPECT_GT(rates.multiply, 1e8);
  EXPECT_GT(rates.add, 1e8);
  EXPECT_EQ(Machine::rounded(300000), std::size_t{1} << 19);
}

}  // namespace
}  // namespace voxmelt::measure
