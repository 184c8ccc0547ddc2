// Gravity and spread of the paper's law agree with the reference in hostile worlds and every size of grid.
// Their faults strike.
#include <cstdint>

#include "hwmodel/pipeline/model/random_block.h"
#include "tests/hwmodel/pipeline/faults/strike_run.h"

namespace voxmelt::hwmodel {
namespace {

const auto make_fall = [](const Design& design, const StageMaker& make, Stages& stages) {
  if (design.needs_walls() && !design.hot()) stages.push_back(make(StageKind::walls, design));
  stages.push_back(make(StageKind::gravity, design));
};
const auto make_spread = [](const Design& design, const StageMaker& make, Stages& stages) {
  stages.push_back(make(StageKind::pattern, design));
  stages.push_back(make(StageKind::apply, design));
};

TEST(PaperStages, GravityIsTheReferences) {
  for (const std::uint64_t seed : {0u, 5000u, 90000u})
    expect_phase(rule::Law::paper, step::Phase::gravity, make_fall, 400, 3, seed);
}

TEST(PaperStages, SpreadIsTheReferences) {
  for (const std::uint64_t seed : {0u, 5000u, 90000u})
    expect_phase(rule::Law::paper, step::Phase::spread, make_spread, 500, 3, seed);
}

// On every axis in turn, the sizes lie around a block of lanes, a word of 64 and nothing at all.
TEST(PaperStages, EverySizeOfGrid) {
  int runs = 0;
  for (const int size : {1, 2, 63, 64, 65})
    for (const int axis : {0, 1, 2})
      for (const int lanes : {1, 4, 16}) {
        worlds::Random random(static_cast<std::uint64_t>(size * 100 + axis * 10 + lanes));
        const int other = random.between(1, 5), third = random.between(1, 5);
        const state::Grid grid = axis == 0   ? state::Grid{size, other, third}
                                 : axis == 1 ? state::Grid{other, size, third}
                                             : state::Grid{other, third, size};
        const Design design{freezing_parameters(random, rule::Law::paper, grid), {grid, lanes}};
        run::Simulation simulation(design.parameters, worlds::hostile_volume(random, design.parameters, grid),
                                   worlds::implementation("reference"));
        Stages falling, spreading;
        make_fall(design, make_stage, falling);
        make_spread(design, make_stage, spreading);
        StageRun run{2, static_cast<std::uint64_t>(runs % 3), 0};
        state::Volume unmelted(grid);
        if (design.walls_in_conduction()) run.sides = &unmelted;
        state::BitPlane set(grid);
        run.set = &set;
        for (std::uint32_t step = 0; step < 3; ++step) {
          worlds::step_by_phase(simulation, [&, before = simulation.volume()](step::Phase phase) mutable {
            if (phase == step::Phase::melt) set = set_places(design.parameters, unmelted = before);
            const bool falls = phase == step::Phase::gravity;
            if (falls || phase == step::Phase::spread) {
              const state::Volume result =
                  run_stages(design, falls ? falling : spreading, step::Moment(step), nullptr, before, run);
              ASSERT_EQ(worlds::difference(simulation.volume(), result), "")
                  << grid.x << " x " << grid.y << " x " << grid.z << ", " << lanes << " lanes";
              ++runs;
            }
            before = simulation.volume();
          });
        }
      }
  EXPECT_EQ(runs, 5 * 3 * 3 * 3 * 2);
}

TEST(PaperStages, RandomBlockIsThePages) {
  EXPECT_EQ(speck_block(speck_keys(0x123456789ABCDEF0u), 77, 5), 0x9E9616A588A7C7A1u);
  EXPECT_EQ(speck_byte(0x9E9616A588A7C7A1u, 8), 0xA1);
  EXPECT_EQ(speck_byte(0x9E9616A588A7C7A1u, 15), 0x9E);
}

TEST(PaperStages, GravityFaultsStrikeWhereTheySay) {
  for (const Fault fault : {Fault::gravity_one_more, Fault::gravity_wall_missed, Fault::gravity_room,
                            Fault::gravity_column_wrap, Fault::gravity_mix}) {
    SCOPED_TRACE(static_cast<int>(fault));
    expect_strikes(rule::Law::paper, step::Phase::gravity, fault, make_fall, 200, 3, 40);
  }
}

TEST(PaperStages, ASetCellFallsWhereTheFaultSays) {
  expect_strikes(rule::Law::paper, step::Phase::gravity, Fault::gravity_set_falls, make_fall, 400, 3, 20);
}

TEST(PaperStages, SpreadFaultsStrikeWhereTheySay) {
  // The faults of `pattern` show inside the phase (faults_test.cpp).
  for (const Fault fault : {Fault::apply_flow_lost, Fault::apply_diagonal_whole, Fault::apply_alpha}) {
    SCOPED_TRACE(static_cast<int>(fault));
    expect_strikes(rule::Law::paper, step::Phase::spread, fault, make_spread, 500, 3, 40);
  }
}

// The fullest receiver is between the fullest givers. The proofs' bounds are reached, and every wire holds.
TEST(PaperStages, WidestSums) {
  for (const int neighbours : {4, 8})
    for (const auto reading : {rule::EnergyReading::text, rule::EnergyReading::printed}) {
      const state::Grid grid{3, 1, 3};
      Design design{worlds::paper_showcase(), {grid, 2}};
      rule::PaperLaw& law = design.parameters.flow.paper;
      design.parameters.heat.enabled = true;
      law.neighbours = neighbours;
      law.share = static_cast<std::uint16_t>(rule::largest_share(neighbours));
      law.alpha_floor = 65535;
      law.reading = reading;
      state::Volume volume(grid);
      worlds::fill(volume, worlds::whole(grid), 65535, 65535, 65535);
      const int lowest = neighbours == 8 ? 45055 : 32767;
      worlds::put(volume, 1, 0, 1, lowest, lowest, 65535);
      Stages stages;
      make_spread(design, make_stage, stages);
      StageRun run;
      int full = 0;
      for (std::uint32_t step = 0; step < 3000; ++step) {
        const state::Volume result = run_stages(design, stages, step::Moment(step), nullptr, volume, run);
        full += result.amount[result.at(1, 0, 1)] == 65535 ? 1 : 0;
      }
      EXPECT_GT(full, 0) << neighbours;
    }
}

// The buffers hold exactly the tokens of the stage's lag.
TEST(PaperStages, BuffersSpanTheLag) {
  for (const int neighbours : {4, 8}) {
    Design design{worlds::paper_showcase(), {{64, 32, 8}, 16}};
    design.parameters.flow.paper.neighbours = neighbours;
    Stages stages;
    make_spread(design, make_stage, stages);
    stages.push_back(make_stage(StageKind::walls, design));
    for (const auto& stage : stages) {
      std::int64_t cells = 0;
      for (const BufferCost& buffer : stage->buffers()) cells += buffer.words * buffer.lanes;
      EXPECT_EQ(cells, stage->lag() * design.shape.lanes) << stage->name();
    }
  }
}

}  // namespace
}  // namespace voxmelt::hwmodel
