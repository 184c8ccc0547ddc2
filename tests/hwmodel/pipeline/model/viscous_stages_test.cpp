// Settle and viscous spread agree with the reference. Spread reads what settle shows, so the two run
// together.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/viscous_run.h"
#include "kernel/automaton/rule/viscous.h"
#include "kernel/engine/scalar/reference.h"
#include "tests/hwmodel/pipeline/model/viscous_worlds.h"

namespace voxmelt::hwmodel {
namespace {

using step::Phase;

void make_excess(const Design& design, const StageMaker& make, Stages& stages) {
  stages.push_back(make(StageKind::settle, design));
}
void make_both(const Design& design, const StageMaker& make, Stages& stages) {
  make_excess(design, make, stages);
  stages.push_back(make(StageKind::viscous_spread, design));
}

TEST(ViscousStages, SettleIsTheReferences) {
  for (const std::uint64_t seed : {0u, 1'000'000u, 2'000'000u})
    expect_phase(rule::Law::viscous, Phase::excess, make_excess, 200, 3, seed);
}

// The columns are tall. Some keep the order of their heat, and others beside them do not.
TEST(ViscousStages, SettleIsTheReferencesInLayers) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    worlds::Random random(seed);
    const state::Grid grid{random.between(1, 9), random.any({4, 31, 32, 40}), 2};
    Design design{worlds::hostile_parameters(random, rule::Law::viscous, grid),
                  {grid, random.any({1, 2, 4})}};
    design.parameters.vents.clear();
    state::Volume start(grid);
    for (int z = 0; z < grid.z; ++z)
      for (int x = 0; x < grid.x; ++x) {
        worlds::put_layers(random, start, x, z, design.hot());
        if (random.one_in(8)) worlds::put_inert(start, x, random.below(grid.y), z);
      }
    ViscousWorld world(design, start);
    Stages stages;
    make_excess(design, make_stage, stages);
    StageRun run;
    for (std::uint32_t step = 0; step < 4; ++step)
      world.step([&](Phase phase, const state::Volume& before) {
        if (phase != Phase::excess) return;
        ASSERT_EQ(worlds::difference(world.simulation.volume(),
                                     run_stages(design, stages, world.moment, nullptr, before, run)),
                  "")
            << "seed " << seed << ", step " << step;
      });
  }
}

TEST(ViscousStages, SpreadIsTheReferences) {
  for (const std::uint64_t seed : {0u, 3'000'000u, 4'000'000u})
    expect_phases(rule::Law::viscous, Phase::excess, Phase::spread, make_both, 200, 3, seed);
}

// Counts pairs along axes that only their being shut keeps from flowing, and pairs of which one is shut.
struct ShutPairs {
  int both = 0, one = 0;

  void count(const ViscousWorld& world, step::Moment moment, const state::Volume& before) {
    state::Volume settled = before;
    state::Ledger ledger;
    scalar::Reference reference(world.design.parameters, before.grid);
    reference.run(Phase::excess, moment, nullptr, settled, ledger);
    const auto look = [&](state::Slot i, state::Slot j) {
      const auto here = reference.run_of(i), there = reference.run_of(j);
      if (!here || !there) return;
      const std::int32_t drop = std::abs(here->head - there->head);
      if (drop <= std::max(here->dead, there->dead)) return;
      both += reference.in_shut_run(i) && reference.in_shut_run(j);
      one += reference.in_shut_run(i) != reference.in_shut_run(j);
    };
    worlds::for_each(worlds::whole(before.grid), [&](int x, int y, int z) {
      if (x + 1 < before.grid.x) look(before.at(x, y, z), before.at(x + 1, y, z));
      if (z + 1 < before.grid.z) look(before.at(x, y, z), before.at(x, y, z + 1));
    });
  }
};

// Runs both stages on a given world for `count` steps.
void expect_steps(ViscousWorld& world, int count, std::uint64_t stall_seed, ShutPairs* pairs = nullptr) {
  Stages stages;
  make_both(world.design, make_stage, stages);
  StageRun run{2, stall_seed};
  for (int i = 0; i < count; ++i) {
    state::Volume start = world.simulation.volume();
    world.step([&](Phase phase, const state::Volume& before) {
      if (phase == Phase::excess) start = before;
      if (phase != Phase::spread) return;
      if (pairs != nullptr) pairs->count(world, world.moment, start);
      run.set = &world.set;
      const state::Volume found = run_stages(world.design, stages, world.moment, nullptr, start, run);
      const state::Grid g = before.grid;
      ASSERT_EQ(worlds::difference(world.simulation.volume(), found), "")
          << g.x << " x " << g.y << " x " << g.z << ", " << world.design.shape.lanes << " lanes, step " << i;
    });
  }
}

// Vaults are full to their ceilings, which lie at many heights.
TEST(ViscousStages, Vaults) {
  ShutPairs pairs;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    worlds::Random random(seed);
    const state::Grid grid = small_grid(random);
    ViscousWorld world = ViscousWorld::of_vaults(random, grid, random.any({1, 2, 4, 8, 16}));
    expect_steps(world, 3, random.one_in(2) ? 0 : 1 + seed, &pairs);
  }
  EXPECT_GT(pairs.both, 1000);
  EXPECT_GT(pairs.one, 1000);
}

TEST(ViscousStages, EverySizeOfAnAxis) {
  worlds::Random random(5);
  int sizes = 0;
  for (const int n : {1, 2, 3, 63, 64, 65})
    for (const int lanes : {1, 2, 4, 8, 16})
      for (const state::Grid grid : {state::Grid{n, 4, 3}, state::Grid{5, n, 3}, state::Grid{5, 4, n}}) {
        ViscousWorld world(random, grid, lanes);
        expect_steps(world, 2, random.one_in(2) ? 0 : 1 + random.bits() % 1000);
        ++sizes;
      }
  EXPECT_EQ(sizes, 90);
}

// These cases are hardly ever hit by random amounts: sums of whole cells, top cells at ONE / 2, and beds
// higher than a scene may have. Some columns are so deep that the mobility's depth is cut.
TEST(ViscousStages, BoundsOfTheRules) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    worlds::Random random(seed);
    const bool deep = random.one_in(4);
    const state::Grid grid{random.between(2, 6), deep ? random.between(64, 90) : random.between(2, 8),
                           random.between(1, 3)};
    rule::Parameters parameters = freezing_parameters(random, rule::Law::viscous, grid);
    parameters.flow.viscous.mobility = random.any<std::uint64_t>({4096, 28672, 126976, 19088744, 1908874400});
    parameters.flow.viscous.yield = static_cast<std::uint32_t>(random.any({0, 131, 40000}));
    parameters.vents.clear();
    parameters.heat.radiation = false;
    state::Volume start(grid);
    worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
      const std::int32_t heat = parameters.heat.enabled ? random.below(65536) : 0;
      if (random.one_in(deep ? 400 : 6))
        worlds::put_inert(start, x, y, z, random.any({0, 2048, 4095, 4200, 65535}));
      else if (const std::int32_t amount =
                   deep && y < 65 ? 4096 : random.any({0, 2047, 2048, 2049, 4095, 4096, 6144, 6145, 8191});
               amount > 0)
        worlds::put(start, x, y, z, amount, 0, heat);
    });
    ViscousWorld world(Design{parameters, {grid, random.any({1, 2, 4})}}, start);
    expect_steps(world, 2, 0);
  }
}

// The tallest grid is as full as can be, so every width is at its limit. An overflow would throw.
// Hot liquid is as mobile as can be, and cold liquid as little: 2^40 becomes 255.
TEST(ViscousStages, WidestNumbers) {
  for (const bool cold : {false, true})
    for (const int height : {1, 2, 255, 256, 4096}) {
      const int stiffness = cold ? 1 : 8;
      worlds::Random random(static_cast<std::uint64_t>(height));
      const state::Grid grid{3, height, 2};
      rule::Parameters parameters = worlds::hostile_parameters(random, rule::Law::viscous, grid);
      parameters.heat.enabled = parameters.flow.thermal_viscosity = true;
      parameters.heat.radiation = parameters.heat.air = false;
      parameters.flow.mobility_reference = cold ? 65535 : 0;
      parameters.flow.mobility_rate = 32767;
      parameters.flow.viscous = {(std::uint64_t{1} << 36) - 1, (1 << 24) - 1,
                                 static_cast<std::uint8_t>(stiffness)};
      state::Volume full(grid);
      worlds::fill(full, worlds::whole(grid), 65535, 0, cold ? 0 : 65535);
      worlds::put_inert(full, 1, 0, 0, 65535);
      for (int y = 1; y < height; ++y) worlds::put(full, 2, y, 1, 0);
      const Design design{parameters, {grid, 2}};
      run::Simulation simulation(parameters, full, worlds::implementation("reference"));
      simulation.begin_step();
      simulation.run_phase(Phase::excess);
      Stages settle, both;
      make_excess(design, make_stage, settle);
      make_both(design, make_stage, both);
      StageRun run;
      ASSERT_EQ(worlds::difference(simulation.volume(),
                                   run_stages(design, settle, step::Moment(0), nullptr, full, run)),
                "");
      simulation.run_phase(Phase::spread);
      ASSERT_EQ(worlds::difference(simulation.volume(),
                                   run_stages(design, both, step::Moment(0), nullptr, full, run)),
                "");
    }
}

// Keeps the cells that pass.
class Tap final : public Stage {
 public:
  Tap(const Design& design) : Stage(StageKind::viscous_spread, design, 0) {}
  const Cell& at(int x, int y, int z) const {
    return cells_[static_cast<std::size_t>(stream_order(shape(), x, y, z))];
  }

 protected:
  void begin_step() override { cells_.clear(); }
  void advance(const Cell* in, Cell* out) override {
    std::copy_n(in, lanes(), out);
    cells_.insert(cells_.end(), in, in + lanes());
  }

 private:
  std::vector<Cell> cells_;
};

bool blocked(const state::Volume& v, int x, int y, int z) {
  return !v.grid.contains(x, y, z) || v.solid.test(x, y, z) || v.inert.test(x, y, z);
}

// Marks the cells that settling leaves in a run, counted cell by cell.
std::vector<bool> in_runs(const state::Volume& v) {
  std::vector<bool> result(v.grid.cells());
  worlds::for_each({0, 0, 0, v.grid.x, v.grid.y, v.grid.z}, [&](int x, int bottom, int z) {
    const auto amount = [&](int y) -> std::int32_t { return v.amount[v.at(x, y, z)]; };
    if (blocked(v, x, bottom, z) || !blocked(v, x, bottom - 1, z) || amount(bottom) == 0) return;
    std::int64_t sum = amount(bottom);
    std::int32_t n = 1;
    while (!blocked(v, x, bottom + n, z) &&
           rule::run_continues(sum, n, amount(bottom + n - 1), amount(bottom + n)))
      sum += amount(bottom + n++);
    for (int k = 0; k < n; ++k) result[v.grid.index(x, bottom + k, z)] = rule::settled(sum, n, k) > 0;
  });
  return result;
}

TEST(ViscousStages, SpreadHandsOnRunsAndWallsAndNothingElse) {
  int runs = 0, walls = 0, set = 0;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    worlds::Random random(seed);
    ViscousWorld world(random, small_grid(random), random.any({1, 2, 4, 8, 16}));
    Stages stages;
    make_both(world.design, make_stage, stages);
    auto tap = std::make_unique<Tap>(world.design);
    const Tap& seen = *tap;
    stages.push_back(std::move(tap));
    StageRun run;
    world.step([&](Phase phase, const state::Volume& before) {
      if (phase != Phase::excess) return;
      run.set = &world.set;
      run_stages(world.design, stages, world.moment, nullptr, before, run);
      const std::vector<bool> expected = in_runs(before);
      worlds::for_each(worlds::whole(before.grid), [&](int x, int y, int z) {
        const Cell& cell = seen.at(x, y, z);
        const bool in_run = cell.in_run, beside_wall = cell.beside_wall;
        const bool wall = blocked(before, x - 1, y, z) || blocked(before, x + 1, y, z) ||
                          blocked(before, x, y, z - 1) || blocked(before, x, y, z + 1);
        ASSERT_EQ(in_run, expected[before.grid.index(x, y, z)]);
        ASSERT_EQ(beside_wall, wall && !blocked(before, x, y, z) && world.design.needs_walls());
        Cell plain = cell;
        const bool is_set = cell.set > 0;
        ASSERT_EQ(is_set, world.set.test(x, y, z));
        plain.in_run = plain.beside_wall = plain.set = 0;
        Cell state_only;
        state_only.state = cell.state;
        state_only.amount = cell.amount;
        state_only.heat = cell.heat;
        state_only.material = cell.material;
        ASSERT_EQ(plain, state_only);
        runs += in_run;
        walls += beside_wall;
        set += is_set;
      });
    });
  }
  EXPECT_GT(runs, 500);
  EXPECT_GT(walls, 500);
  EXPECT_GT(set, 500);
}

// A solid melts at 30000 and takes up `latent`.
Design bed_design(const state::Grid& grid, std::uint16_t latent, bool hot = true) {
  Design design{{}, {grid, 1}};
  rule::Parameters& parameters = design.parameters;
  parameters.flow.law = rule::Law::viscous;
  parameters.flow.viscous.mobility = (std::uint64_t{1} << 36) - 1;
  parameters.heat.enabled = hot;
  parameters.material.melting_point = 30000;
  parameters.material.latent_heat = latent;
  return design;
}

// With latent heat 8192, W = 8192, k = 2, w = 32768, scale = 2^28 / 32768 = 8192. A rise is (b + 2048) >> 3.
TEST(SolidBed, ByHand) {
  const Design design = bed_design({1, 1, 1}, 8192);
  const SolidBed bed(design);
  // Cold: lack = W, part = (4 x 8192 x 8192) >> 16 = 4096. So b + 2048 is 1024 and 4096, and 6143 at most.
  EXPECT_EQ(bed.rise(1024, 20000), 128);
  EXPECT_EQ(bed.rise(4096, 30000), 512);
  EXPECT_EQ(bed.rise(65535, 0), 767);
  // Half way: h = 38192 - 4096, lack = 4096, part = 2048. b + 2048 = 512, and floor(6143 / 2) = 3071.
  EXPECT_EQ(bed.rise(1024, 34096), 64);
  EXPECT_EQ(bed.rise(6144, 34096), 383);
  // Melted: lack = 1, part = (4 x 1 x 8192) >> 16 = 0; and nothing lacks.
  EXPECT_EQ(bed.rise(65535, 38191), 0);
  EXPECT_EQ(bed.rise(65535, 65535), 0);
  EXPECT_EQ(SolidBed(bed_design({1, 1, 1}, 8192, false)).rise(1024, 65535), 128) << "without heat";
}

// The melt has 35000 units. W = 5000, k = 3 (80000 is too much), w = 40000. The scale is 6710.9, rounded up
// to 6711. At lack = 5000, part = (40000 x 6711) >> 16 = 4096.07. At 2500 it is 2048.03, at 2499 it is
// 2047.2.
TEST(SolidBed, OfAWholeThatIsNoPowerOfTwo) {
  const SolidBed bed(bed_design({1, 1, 1}, 5000));
  EXPECT_EQ(bed.rise(4096, 30000), 512);
  EXPECT_EQ(bed.rise(4096, 32500), 256);
  EXPECT_EQ(bed.rise(4096, 32501), 255);
}

// The second material melts at 20000 with a warmth of 1/2: it is solid up to 40000, takes 8192 more, and is
// liquid from 48192 on. Half way: h = 48192 - 4096, as above. The first one is melted at 38192.
TEST(SolidBed, OfASecondMaterial) {
  Design design = bed_design({1, 1, 1}, 8192);
  design.parameters.materials = {{.melting_point = 30000, .latent_heat = 8192},
                                 {.melting_point = 20000, .latent_heat = 8192, .warmth = 32768}};
  const SolidBed bed(design);
  EXPECT_EQ(bed.rise(1024, 40000, 1), 128);
  EXPECT_EQ(bed.rise(1024, 44096, 1), 64);
  EXPECT_EQ(bed.rise(65535, 48191, 1), 0);
  EXPECT_EQ(bed.rise(1024, 34096, 0), 64);
  EXPECT_EQ(bed.rise(65535, 40000, 0), 0);
}

// At all latent heats no wire is too narrow, a cold solid is filled by its amount, and a bed never rises as
// it warms. Less latent heat than ONE counts as ONE.
TEST(SolidBed, FitsItsWires) {
  for (int latent = 0; latent <= 35535; latent += latent < 5000 ? 1 : 61) {
    const SolidBed bed(bed_design({1, 1, 1}, static_cast<std::uint16_t>(latent)));
    const int melt = 30000 + latent, range = std::max(latent, 4096);
    std::int64_t last = 767;
    for (int heat = 0; heat <= 65535; heat += 257) {
      const std::int64_t rise = bed.rise(65535, heat);
      ASSERT_LE(rise, last);
      last = rise;
    }
    ASSERT_EQ(bed.rise(1024, melt - range), 128) << latent;
    ASSERT_EQ(bed.rise(65535, melt), 0) << latent;
  }
}

// Liquid of 2048 stands on four blocked cells, so each head is its bed and 2048 >> 3 = 256. The beds: solids
// of SolidBed.ByHand with 128, 64 and 512, and an inert cell with 512 + ((1024 - 2048) >> 3) = 384.
TEST(ViscousStages, SettleStandsOnSolidBeds) {
  const Design design = bed_design({4, 2, 1}, 8192);
  state::Volume start(design.shape.grid);
  worlds::put_solid(start, 0, 0, 0, 1024, 20000);
  worlds::put_solid(start, 1, 0, 0, 1024, 34096);
  worlds::put_solid(start, 2, 0, 0, 4096, 20000);
  worlds::put_inert(start, 3, 0, 0, 1024);
  for (int x = 0; x < 4; ++x) worlds::put(start, x, 1, 0, 2048, 0, 40000);
  Stages stages;
  make_excess(design, make_stage, stages);
  auto tap = std::make_unique<Tap>(design);
  const Tap& seen = *tap;
  stages.push_back(std::move(tap));
  StageRun run;
  run_stages(design, stages, step::Moment(0), nullptr, start, run);
  EXPECT_EQ(seen.at(0, 1, 0).head, 384);
  EXPECT_EQ(seen.at(1, 1, 0).head, 320);
  EXPECT_EQ(seen.at(2, 1, 0).head, 768);
  EXPECT_EQ(seen.at(3, 1, 0).head, 640);
}

// A column of two cells holds two full cells and `excess`, and has this above it.
enum class Above { border, inert, solid, air };
bool shows_shut(std::int32_t excess, Above above, bool hot) {
  const Design design = bed_design({1, above == Above::border ? 2 : 4, 1}, 8192, hot);
  state::Volume start(design.shape.grid);
  worlds::put(start, 0, 0, 0, 4096, 0, hot ? 40000 : 0);
  worlds::put(start, 0, 1, 0, 4096 + excess, 0, hot ? 40000 : 0);
  if (above == Above::inert) worlds::put_inert(start, 0, 2, 0);
  if (above == Above::solid) worlds::put_solid(start, 0, 2, 0);
  Stages stages;
  make_excess(design, make_stage, stages);
  auto tap = std::make_unique<Tap>(design);
  const Tap& seen = *tap;
  stages.push_back(std::move(tap));
  StageRun run;
  run_stages(design, stages, step::Moment(0), nullptr, start, run);
  EXPECT_EQ(seen.at(0, 0, 0).in_run, 1);
  EXPECT_EQ(seen.at(0, 0, 0).shut, seen.at(0, 1, 0).shut) << "one cell of a run is, the other is not";
  return seen.at(0, 0, 0).shut == 1;
}

// ONE / 64 is 64.
TEST(ViscousStages, ARunIsShutIfFullUnderACeiling) {
  for (const bool hot : {false, true}) {
    for (const Above above : {Above::border, Above::inert, Above::solid}) {
      for (const std::int32_t excess : {-64, -1, 0, 1, 64})
        EXPECT_TRUE(shows_shut(excess, above, hot)) << excess << ", " << static_cast<int>(above);
      for (const std::int32_t excess : {-4000, -65, 65, 9000})
        EXPECT_FALSE(shows_shut(excess, above, hot)) << excess << ", " << static_cast<int>(above);
    }
    for (const std::int32_t excess : {-64, 0, 64})
      EXPECT_FALSE(shows_shut(excess, Above::air, hot)) << excess;
  }
}

// A run of one cell and one of two stand side by side under inert cells, with a drop of a whole cell. Both
// are shut: nothing flows. Without 65 units the higher one is not shut, and gives.
TEST(ViscousStages, ShutRunsGiveEachOtherNothing) {
  const auto given = [](std::int32_t lacking) {
    const Design design = bed_design({2, 3, 1}, 8192);
    state::Volume start(design.shape.grid);
    worlds::put(start, 0, 0, 0, 4096, 0, 40000);
    worlds::put_inert(start, 0, 1, 0);
    worlds::put(start, 1, 0, 0, 4096, 0, 40000);
    worlds::put(start, 1, 1, 0, 4096 - lacking, 0, 40000);
    worlds::put_inert(start, 1, 2, 0);
    Stages stages;
    make_both(design, make_stage, stages);
    StageRun run;
    const state::Volume found = run_stages(design, stages, step::Moment(0), nullptr, start, run);
    return found.amount[found.at(0, 0, 0)] - 4096;
  };
  EXPECT_EQ(given(0), 0);
  EXPECT_EQ(given(64), 0);
  EXPECT_GT(given(65), 100);
}

// Liquid of 2048 on a full solid flows to the air above a solid of 1024, by one axis. The beds are 512 and
// 128, so the slope is t = 16 - 4 = 12: q = 144, root = 2^22 / 400 = 10485, 10485^2 >> 14 = 6709. All four
// cells beside the pair are border: s = 6709 + 4 x 838 = 10061. The drop of 768 - 128 = 640 is cut to 512,
// drive = 10061 x 512 >> 10 = 5030. exposed = 2^21, a = 2048, c = 2^20. The layer y = 1 has the dither 32768.
// The flow is (2^20 x 5030 + 32768 x 2^10) >> 26 = floor(78.59 + 0.5) = 79, less than a fifth of 2048.
TEST(ViscousStages, SpreadFlowsDownToASolidBed) {
  const Design design = bed_design({2, 2, 1}, 8192);
  state::Volume start(design.shape.grid);
  worlds::put_solid(start, 0, 0, 0, 4096, 20000);
  worlds::put_solid(start, 1, 0, 0, 1024, 20000);
  worlds::put(start, 0, 1, 0, 2048, 0, 40000);
  Stages stages;
  make_both(design, make_stage, stages);
  StageRun run;
  const state::Volume found = run_stages(design, stages, step::Moment(0), nullptr, start, run);
  EXPECT_EQ(found.amount[found.at(0, 1, 0)], 1969);
  EXPECT_EQ(found.amount[found.at(1, 1, 0)], 79);
  EXPECT_EQ(found.amount[found.at(1, 0, 0)], 1024);
}

}  // namespace
}  // namespace voxmelt::hwmodel
