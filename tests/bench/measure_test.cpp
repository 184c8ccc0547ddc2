// The benchmark itself: it refuses wrong results, its workloads do what they say, its arithmetic is right.
#include "bench/measure/measure.h"

#include <gtest/gtest.h>

#include "bench/measure/machine.h"
#include "bench/measure/report.h"
#include "bench/measure/roof.h"
#include "bench/measure/suite.h"
#include "kernel/automaton/state/digest.h"
#include "kernel/engine/scalar/reference.h"
#include "kernel/run/simulation.h"

namespace voxmelt::measure {
namespace {

// The reference, but for one fault in one cell.
enum class Fault { amount, leak };
template <Fault fault>
class Faulty : public step::Stepper {
 public:
  Faulty(const rule::Parameters& parameters, state::Grid grid, const step::Tuning& tuning)
      : sound_(scalar::create_reference(parameters, grid, tuning)) {}

  void run(step::Phase phase, std::uint32_t step, const step::Irradiance* irradiance, state::Volume& volume,
           state::Ledger& ledger) override {
    sound_->run(phase, step, irradiance, volume, ledger);
    if (phase != step::Phase::spread || step != 1) return;
    if (fault == Fault::amount)
      ++volume.amount[volume.at(3, 3, 3)];
    else
      ++ledger.mass.added;
  }

 private:
  std::unique_ptr<step::Stepper> sound_;
};

template <Fault fault>
step::Implementation faulty() {
  return {"faulty", "",
          [](const rule::Parameters& parameters, state::Grid grid,
             const step::Tuning& tuning) -> std::unique_ptr<step::Stepper> {
            return std::make_unique<Faulty<fault>>(parameters, grid, tuning);
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
}

// Every round against what was measured beside it; bytes, which are not, against the best.
TEST(Measure, TheRoofBesideIsOfEachRound) {
  Case one;
  one.active = 100;
  one.work.multiplies = 1;
  one.work.others = 9;
  one.work.bytes = 2;
  EXPECT_FALSE(one.percent_of_roof_beside());
  one.roof = Roof{1000, 1e6};
  one.rounds = {{1, 9, {1e9, 10'000}}, {2, 9, {1e9, 2'500}}, {4, 9, {1e9, 2'500}}};  // 10, 20 and 10 %
  EXPECT_DOUBLE_EQ(*one.percent_of_roof_beside(), 10);
  one.rounds[2].rates.multiply = 50;  // 50 %
  EXPECT_DOUBLE_EQ(*one.percent_of_roof_beside(), 20);
  one.roof->bytes = 125;  // 80, 40 and 50 %
  EXPECT_DOUBLE_EQ(*one.percent_of_roof_beside(), 50);
  one.subject = Subject::heat;  // (100 / 9) / 125
  EXPECT_NEAR(*one.percent_of_roof_beside(), 100.0 / 9 / 125 * 100, 1e-9);
}

// The machine is asked right before and after every timed run; the better answer counts.
TEST(Measure, RatesAreTakenBesideEveryRun) {
  const Workload workload = dense_paper(4, false);
  double asked = 0;
  const auto rates_now = [&](const Candidate&) {
    ++asked;
    return LaneRates{100 - asked, asked};
  };
  const Result result =
      measure(workload, {{&run::implementations().all().front(), 1}}, {3, 0}, false, rates_now);
  const std::vector<Round>& rounds = result.timings.at(0).rounds;
  ASSERT_EQ(rounds.size(), 3U);
  for (std::size_t i = 0; i < rounds.size(); ++i) {
    EXPECT_EQ(rounds[i].rates.multiply, 100 - (2.0 * static_cast<double>(i) + 1)) << "before";
    EXPECT_EQ(rounds[i].rates.add, 2.0 * static_cast<double>(i) + 2) << "after";
    EXPECT_GT(rounds[i].flow, 0);
  }
}

TEST(Measure, MediansAndDigits) {
  EXPECT_DOUBLE_EQ(median({3, 1, 2}), 2);
  EXPECT_DOUBLE_EQ(median({4, 1, 2, 3}), 2.5);
  EXPECT_EQ(three_digits(0.01234), "0.012");
  EXPECT_EQ(three_digits(1.234), "1.23");
  EXPECT_EQ(three_digits(99.99), "100");
}

TEST(Machine, MoreThreadsAreNeverAWorseBound) {
  Machine machine(0.001);
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
