// Every fault of source, heat and melt is planted. If it strikes, the phase's result is wrong, and the first
// wrong cell in the order of the stream is the one that it names.
#include <algorithm>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "hwmodel/pipeline/faults/planted_stages.h"
#include "tests/hwmodel/pipeline/model/heat_stages.h"
#include "tests/rounds.h"

namespace voxmelt::hwmodel {
namespace {

using Make = void (*)(const Design&, const StageMaker&, Stages&);

struct Planted {
  Fault fault;
  step::Phase phase;
  Make make;
  std::vector<std::string> stages;  // stages that must be struck in some world
};

// Counts the strikes by stage, over hostile worlds.
std::map<std::string, int> strikes(const Planted& planted, int count) {
  std::map<std::string, int> struck;
  for (int world = 0; world < count; ++world) {
    worlds::Random random(static_cast<std::uint64_t>(world) * 7919 + 5);
    const state::Grid grid{random.between(1, 12), random.between(1, 9), random.between(1, 6)};
    const rule::Law law = random.any({rule::Law::paper, rule::Law::viscous});
    Design design{freezing_parameters(random, law, grid), {grid, random.any({1, 2, 4, 8, 16})}};
    const state::Volume start = volume_of_materials(random, design.parameters, grid);
    FaultPlan plan(planted.fault, random.one_in(2) ? 0 : 1);
    Stages stages;
    planted.make(design, planted_stages(plan), stages);
    if (stages.empty()) continue;
    StageRun run{random.any({1, 2, 5}), random.one_in(2) ? 0u : 7u, 0};
    each_phase(design.parameters, start, planted.phase, 3,
               [&](std::uint32_t step, const auto& before, const auto& after, auto* irradiance) {
                 const state::Volume result =
                     run_stages(design, stages, step::Moment(step), irradiance, before, run);
                 const auto found = first_difference(design.shape, after, result);
                 EXPECT_EQ(found.has_value(), plan.struck().has_value()) << "world " << world;
                 if (!found || !plan.struck()) return !found;
                 const FaultPlan::Strike& strike = *plan.struck();
                 EXPECT_EQ(*found, (CellAt{strike.x, strike.y, strike.z}))
                     << "world " << world << ", " << strike.where << ": " << found->x << ' ' << found->y
                     << ' ' << found->z << ", struck " << strike.x << ' ' << strike.y << ' ' << strike.z;
                 EXPECT_EQ(strike.step, step);
                 EXPECT_GE(strike.step, plan.first_step());
                 ++struck[strike.where];
                 return false;
               });
  }
  return struck;
}

void expect_struck(const Planted& planted) {
  const auto name = std::find_if(all_faults().begin(), all_faults().end(), [&](const FaultInfo& one) {
                      return one.fault == planted.fault;
                    })->name;
  std::map<std::string, int> struck = strikes(planted, rounds(400));
  for (const std::string& stage : planted.stages)
    EXPECT_GE(struck[stage], rounds(3)) << name << " in " << stage;
  EXPECT_EQ(struck.size(), planted.stages.size()) << name;
}

TEST(HeatFaults, Source) {
  expect_struck({Fault::vent_rate, step::Phase::source, source_of, {"source"}});
  expect_struck({Fault::drain_energy, step::Phase::source, source_of, {"source"}});
}

TEST(HeatFaults, Conduction) {
  for (const Fault fault : {Fault::conduction_sign, Fault::conduction_dither, Fault::conduction_stale_row})
    expect_struck({fault, step::Phase::heat, heat_of, {"conduction", "edges", "corners"}});
  expect_struck({Fault::wall_drifts, step::Phase::heat, heat_of, {"conduction", "edges", "corners"}});
  for (const Fault fault : {Fault::conduction_first, Fault::conduction_mean})
    expect_struck({fault, step::Phase::heat, heat_of, {"conduction", "edges", "corners"}});
  expect_struck({Fault::distant_wrong_axis, step::Phase::heat, heat_of, {"edges", "corners"}});
}

TEST(HeatFaults, ConvectionAndExchange) {
  expect_struck({Fault::convection_downwards, step::Phase::heat, heat_of, {"convection"}});
  expect_struck({Fault::irradiance_lane, step::Phase::heat, heat_of, {"exchange"}});
  expect_struck({Fault::air_axis_missed, step::Phase::heat, heat_of, {"exchange"}});
  expect_struck({Fault::glow_square, step::Phase::heat, heat_of, {"exchange"}});
  expect_struck({Fault::air_first, step::Phase::heat, heat_of, {"exchange"}});
  expect_struck({Fault::air_warmth, step::Phase::heat, heat_of, {"exchange"}});
}

TEST(HeatFaults, Melt) {
  expect_struck({Fault::melt_stuck, step::Phase::melt, melt_of, {"melt"}});
  expect_struck({Fault::melt_energy, step::Phase::melt, melt_of, {"melt"}});
  expect_struck({Fault::melt_material, step::Phase::melt, melt_of, {"melt"}});
  expect_struck({Fault::melt_heat, step::Phase::melt, melt_of, {"melt"}});
  expect_struck({Fault::freeze_film, step::Phase::melt, melt_of, {"melt"}});
}

TEST(HeatFaults, BufferBit) {
  expect_struck({Fault::buffer_bit, step::Phase::heat, heat_of, {"conduction"}});
}

}  // namespace
}  // namespace voxmelt::hwmodel
