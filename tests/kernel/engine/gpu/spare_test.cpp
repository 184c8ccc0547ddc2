// A device fails at any of the things that it is asked for. Then the spare goes on, and nothing of the run is
// lost.
#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <string>

#include "tests/kernel/engine/gpu/failing_device.h"
#include "tests/kernel/engine/gpu/same_light.h"

namespace voxmelt::gpu {
namespace {

using namespace worlds;

struct Told {
  int times = 0;
  std::string why;
};

step::Implementation failing(int times, Failure how, Told& told) {
  step::Implementation device{
      "device", "",
      [times, how](const Parameters& p, Grid grid, const step::Tuning&) -> std::unique_ptr<step::Stepper> {
        return std::make_unique<Stepper>(std::make_shared<FailingDevice>(plain_device(1), times, how), p,
                                         grid);
      }};
  device.spare = &implementation("reference");
  device.told = [&told](const DeviceError& why) {
    ++told.times;
    told.why = why.what();
  };
  return device;
}

Volume block() {
  Volume v(Grid{34, 9, 10});
  for_each({5, 2, 3, 33, 8, 9}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 25000); });
  fill(v, {0, 0, 0, 5, 2, 10}, kOne / 2);
  return v;
}
Parameters lit(rule::Law law) {
  Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.02);
  p.heat = visibility::shone_by(
      {Shine{rule::SourceKind::point, {.at = {16 * 20, 16 * 12, 16 * 8}, .power = std::uint64_t{1} << 27}},
       Shine{rule::SourceKind::sky, {.power = std::uint64_t{1} << 19}}},
      4, 1);
  p.heat.weight_face = 8000;
  p.heat.visibility_every = 3;
  return p;
}

// Its sources change, a hand carves, and the state is looked at now and then.
void run_on(run::Simulation& one) {
  steps(one, 2);
  one.volume();
  steps(one, 2);
  rule::Heat other = one.parameters().heat;
  other.sources.pop_back();
  one.change_sources({other.sources, {}, {}});
  steps(one, 3);
  one.irradiance();
  steps(one, 1);
  one.carve({{16 * 8, 16 * 8, 16 * 8}, 40});
  steps(one, 2);
  Parameters changed = one.parameters();
  changed.heat.weight_face = 3000;
  one.change_parameters(changed);
  steps(one, 2);
}

class Spare : public testing::TestWithParam<rule::Law> {};

TEST_P(Spare, GoesOnWhereverTheDeviceFails) {
  run::Simulation expected(lit(GetParam()), block(), implementation("reference"));
  run_on(expected);
  EXPECT_GT(expected.volume().liquid.count(), 100) << "nothing has melted: this shows little";
  int failed = 0, whole = 0;
  for (int times = 0; whole == 0; ++times) {
    Told told;
    const Failure how = times % 3 == 0 ? Failure::is_lost : Failure::refuses;
    run::Simulation actual(lit(GetParam()), block(), failing(times, how, told));
    run_on(actual);
    ASSERT_EQ(difference_of_runs(expected, actual), "") << "after " << times;
    const bool fails = told.times > 0;
    ASSERT_EQ(told.times, fails ? 1 : 0);
    ASSERT_EQ(actual.implementation(), fails ? "reference" : "device");
    ASSERT_EQ(actual.failure(), fails ? "device: " + told.why : "");
    (fails ? failed : whole) += 1;
  }
  EXPECT_GT(failed, 100);
}

INSTANTIATE_TEST_SUITE_P(Laws, Spare, testing::Values(rule::Law::paper, rule::Law::viscous),
                         [](const auto& law) { return law.param == rule::Law::paper ? "paper" : "viscous"; });

TEST(SpareOf, NoneEndsTheRun) {
  Told told;
  step::Implementation device = failing(60, Failure::refuses, told);
  device.spare = nullptr;
  run::Simulation run(lit(rule::Law::paper), block(), device);
  EXPECT_THROW(steps(run, 20), DeviceError);
  EXPECT_EQ(told.times, 0);
}

// The state would go to and fro in every step, and back to one that falls again.
TEST(SpareOf, TakesScenesWherePiecesFall) {
  Parameters p = lit(rule::Law::paper);
  p.pieces.fall = true;
  Told told;
  run::Simulation run(p, block(), failing(1 << 20, Failure::refuses, told));
  EXPECT_EQ(run.implementation(), "reference");
  EXPECT_EQ(told.times, 0) << "nothing has failed";
}

}  // namespace
}  // namespace voxmelt::gpu
