// Changes in one tile can wake a sleeping tile beyond it. Each test takes one cause, in worlds where nothing
// else moves. The bits must be the reference's after every phase, with the smallest tiles.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <tuple>
#include <vector>

#include "kernel/engine/visibility/visibility.h"
#include "tests/kernel/engine/parallel/equal.h"

namespace voxmelt::parallel {
namespace {

using namespace worlds;

step::Tuning sleepy(int threads, int tile_shift) {
  return {.threads = threads, .sleep = true, .tile_shift = tile_shift};
}

bool same_asleep(const Parameters& parameters, const Volume& start, int count) {
  for (const int threads : {1, 2})
    for (const int tile_shift : {0, 1, 3})
      if (!same_steps(parameters, start, fast_implementations().back(), sleepy(threads, tile_shift), count))
        return false;
  return true;
}

Parameters with_drops(rule::Law law) {
  Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.1);
  p.flow.fall.hang = 1024;
  p.heat.enabled = p.heat.air = true;
  p.heat.weight_face = 0;
  p.heat.air_exchange = 2000;
  p.heat.air_temperature.assign(8, 40000);
  p.material.melting_point = 30000;
  return p;
}

// A drop hangs in free air by one solid, above or beside it. Then the solid melts.
TEST(Sleep, WhatHungFromAMeltingSolidFalls) {
  constexpr int kPlaces[5][3] = {{0, 1, 0}, {1, 0, 0}, {-1, 0, 0}, {0, 0, 1}, {0, 0, -1}};
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous})
    for (const auto& [dx, dy, dz] : kPlaces) {
      const int x = dx > 0 ? 63 : 64;
      Volume start({130, 8, 7});
      put_solid(start, x + dx, 4 + dy, 3 + dz, 4096, 20000);
      put(start, x, 4, 3, 900, 0, 40000);
      ASSERT_TRUE(same_asleep(with_drops(law), start, 18)) << dx << dy << dz;
    }
}

// Under the paper's law, a film clings to a solid that melts and stays where it is. The film falls one step
// later, when nothing else moves.
TEST(Sleep, WhatClungToAMeltedSolidFalls) {
  constexpr int kSides[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (const bool drips : {true, false})
    for (const auto& [dx, dz] : kSides)
      for (const int z : {2, 3, 4}) {  // within a chunk, beside a cut
        Parameters p = with_drops(rule::Law::paper);
        p.flow.fall.hang = drips ? 1024 : 0;
        p.flow.fall.wall_factor = drips ? 65536 : 0;
        p.flow.fall.minimum = 0;
        p.flow.paper.threshold = 65535;
        p.flow.paper.slump = 0;
        const int x = dx > 0 ? 63 : 64;
        Volume start({130, 8, 7});
        put_solid(start, x + dx, 4, z + dz, 4096, 20000);
        put_inert(start, x + dx, 3, z + dz);
        put(start, x, 4, z, 900, 0, 40000);
        run::Simulation reference = simulate(p, start);
        int melted = 0;
        while (reference.volume().solid.count() > 0 && melted < 18) {
          reference.step();
          ++melted;
        }
        ASSERT_LT(melted, 16);
        ASSERT_EQ(amount_at(reference, x, 4, z), 900);
        reference.step();
        ASSERT_EQ(amount_at(reference, x, 3, z), 900);
        ASSERT_TRUE(same_asleep(p, start, 18)) << drips << dx << dz << z;
      }
}

// Here a step melts twice or not at all, or nothing falls after it. Sides last until the gravity that
// follows, or until another melt.
TEST(Sleep, SidesGoWithTheNextGravityOrMelt) {
  Parameters p = with_drops(rule::Law::paper);
  p.heat.air_exchange = 20000;
  p.flow.fall.wall_factor = 30000;
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    Random random(seed);
    const Grid grid{random.any({5, 66}), 8, random.between(1, 6)};
    Volume start(grid);
    for_each(whole(grid), [&](int x, int y, int z) {
      const int kind = random.below(6), heat = random.between(10000, 29000);
      if (kind == 0) put_solid(start, x, y, z, 4096, heat);
      if (kind == 1) put(start, x, y, z, random.between(1, 5000), 0, heat);
      if (kind == 2 && y < 2) put_inert(start, x, y, z);
    });
    run::Simulation expected = simulate(p, start);
    const int threads = random.between(1, 2), tile_shift = random.any({0, 1, 3});
    run::Simulation actual(p, start, implementation(fast_implementations().back()),
                           sleepy(threads, tile_shift));
    for (int i = 0; i < 12; ++i) {
      using enum step::Phase;
      std::vector<step::Phase> phases;
      if (random.below(2) == 0) phases.push_back(heat);
      phases.insert(phases.end(), static_cast<std::size_t>(random.below(3)), melt);
      if (random.below(4) != 0) phases.insert(phases.end(), {gravity, spread});
      for (const step::Phase phase : phases) {
        expected.run_phase(phase);
        actual.run_phase(phase);
        ASSERT_EQ(difference(expected.volume(), actual.volume()), "") << seed << ", round " << i;
      }
    }
  }
}

// The lowest cell of a shaft of full cells is drained, then fed. The whole shaft moves in one step.
TEST(Sleep, ShaftsMoveWhole) {
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) {
    const Grid grid{3, 30, 3};
    Parameters p = law == rule::Law::paper ? paper_showcase() : viscous(0.1);
    p.drains.push_back({{{24, 8, 24}, 1}, 9000, 5, 7});
    p.vents.push_back({{{24, 8, 24}, 1}, 9000, 0, 4096, 40, 44});
    Volume start(grid);
    fill_inert(start, whole(grid));
    for_each({1, 0, 1, 2, 30, 2}, [&](int x, int y, int z) {
      start.inert.set(x, y, z, false);
      put(start, x, y, z, y < 25 ? 4096 : 0);
    });
    ASSERT_TRUE(same_asleep(p, start, 55));
  }
}

// Liquid that falls exposes a solid two tiles above where it lands. That solid warms.
TEST(Sleep, WhatAFallBaresWarms) {
  const Grid grid{3, 4, 3};
  Parameters p = paper_showcase();
  p.heat.enabled = p.heat.air = true;
  p.heat.air_exchange = 2000;
  p.heat.air_temperature.assign(4, 40000);
  p.material.melting_point = 30000;
  p.drains.push_back({{{24, 8, 24}, 1}, 900, 5, 6});
  Volume start(grid);
  fill_inert(start, whole(grid));
  for (int y = 0; y < 3; ++y) start.inert.set(1, y, 1, false);
  put(start, 1, 0, 1, 4096, 0, 20000);
  put(start, 1, 1, 1, 500, 0, 20000);
  put_solid(start, 1, 2, 1, 4096, 20000);
  ASSERT_TRUE(same_asleep(p, start, 12));
}

// The wall that a drop clings to melts, and the drop falls. The drop on the wall's other side may then spread
// to its place.
TEST(Sleep, WhatAFallBaresIsSpreadTo) {
  Parameters p = with_drops(rule::Law::paper);
  p.flow.paper.neighbours = 4;
  p.flow.paper.threshold = 0;
  p.flow.paper.margin = 100;
  Volume start({5, 8, 7});
  put_solid(start, 2, 5, 2, 4096, 20000);
  put(start, 2, 5, 3, 900, 0, 40000);
  fill_inert(start, {1, 4, 4, 4, 6, 6});
  start.inert.set(2, 5, 4, false);
  put(start, 2, 5, 4, 300, 300, 40000);
  for (p.seed = 0; p.seed < 8; ++p.seed) ASSERT_TRUE(same_asleep(p, start, 18));
}

// Warm liquid would give more than the step between two cells, so it gives nothing. As it cools, it would
// give less, and may flow.
TEST(Sleep, WhatCoolsMayFlow) {
  const Grid grid{4, 3, 3};
  Parameters p = paper_showcase();
  p.flow.paper.threshold = 0;
  p.flow.paper.margin = 1;
  p.flow.paper.share = 13107;
  p.flow.thermal_viscosity = true;
  p.flow.mobility_table.fill(32768);
  std::fill_n(p.flow.mobility_table.begin(), 20, std::uint16_t{2000});
  p.heat.enabled = p.heat.air = true;
  p.heat.air_exchange = 1000;
  p.heat.air_temperature.assign(3, 30000);
  p.material.melting_point = 65535;
  Volume start(grid);
  fill_inert(start, {0, 0, 0, 4, 1, 3});
  for (const int x : {1, 2}) {
    start.inert.set(x, 0, 1, false);
    put(start, x, 0, 1, x == 1 ? 4096 : 3900, 3900, 42000);
  }
  ASSERT_TRUE(same_asleep(p, start, 20));
}

// A vent brings heat to one cell. It crosses three rows in one step: over an edge and a corner, or over a
// corner and by convection.
TEST(Sleep, HeatGoesOnInTheSameStep) {
  for (const bool edge : {true, false}) {
    const Grid grid{6, 5, 6};
    Parameters p = paper_showcase();
    p.heat.enabled = true;
    p.heat.neighbours = 26;
    p.heat.weight_face = 10922;
    p.heat.weight_edge = edge ? 5461 : 0;
    p.heat.weight_corner = 3640;
    p.heat.convection = edge ? 0 : 20000;
    p.material.melting_point = 65535;
    p.vents.push_back({{{24, 8, 24}, 1}, 2000, 65535, 0, 5, 6});
    Volume start(grid);
    fill_inert(start, {0, 0, 0, 6, edge ? 1 : 3, 6});
    start.inert.set(1, 0, 1, false);
    put(start, 1, 0, 1, 1000, 0, 20000);
    if (edge) {
      put_solid(start, 2, 1, 1, 4096, 20000);
      put_solid(start, 3, 2, 2, 4096, 20000);
    } else {
      for (const int y : {1, 2}) {
        start.inert.set(2, y, 2, false);
        put(start, 2, y, 2, 4096, 0, 20000);
      }
    }
    ASSERT_TRUE(same_asleep(p, start, 10)) << edge;
  }
}

// A slab melts in the light of a lamp. Far below it a solid rests in its shadow, in tiles of its own, until
// the lamp shines on it. It warms from then on, whether the provider tells what is new or not.
TEST(Sleep, WhatComesOutOfAShadowWarms) {
  Parameters p = paper_showcase();
  p.heat.enabled = p.heat.radiation = true;
  p.heat.weight_face = 2000;
  p.material.melting_point = 30000;
  p.heat.sources = {{{{0, {16 * 65, 16 * 40, 16 * 4}, std::uint64_t{1} << 30}}}};
  Volume start({130, 24, 9});
  for_each({56, 20, 0, 74, 21, 9}, [&](int x, int y, int z) { put_solid(start, x, y, z, 4096, 24000); });
  for_each({62, 2, 3, 68, 4, 6}, [&](int x, int y, int z) { put_solid(start, x, y, z, 4096, 10000); });
  for (p.heat.visibility_every = 1; p.heat.visibility_every <= 4; p.heat.visibility_every *= 4) {
    run::Simulation expected = simulate(p, start);
    const auto warmth = [&] { return expected.volume().heat[start.at(65, 3, 4)]; };
    int shaded = 0;
    for (; warmth() == 10000 && shaded < 40; ++shaded) expected.step();
    ASSERT_GT(shaded, 5) << "it sleeps first";
    ASSERT_LT(shaded, 40) << "the slab melts";
    ASSERT_TRUE(same_asleep(p, start, shaded + 5));
    run::Simulation untold(p, start, implementation(fast_implementations().back()), sleepy(2, 0),
                           std::make_unique<visibility::VoxelWalkProvider>());
    for (int step = 0; step < shaded; ++step) untold.step();
    ASSERT_EQ(difference(expected.volume(), untold.volume()), "");
  }
}

// A wall ten units warmer gives one unit in about a hundred steps. Until then nothing changes. The wall lies
// in another word, tile row or slice, over a face, an edge or a corner.
TEST(Sleep, AWallGivesWhenItsTimeComes) {
  for (const auto& [dx, dy, dz] : {std::tuple(1, 0, 0), {0, 1, 0}, {0, 0, 1}, {-1, 0, -1}, {1, -1, 1}}) {
    Parameters p = paper_showcase();
    p.heat.enabled = p.heat.walls = true;
    p.heat.neighbours = 26;
    p.heat.weight_face = p.heat.weight_edge = p.heat.weight_corner = 60;
    p.material.melting_point = 65535;
    Volume v(Grid{130, 18, 4});
    const int x = dx > 0 ? 63 : 64, y = dy > 0 ? 7 : 8, z = 1;
    put_solid(v, x, y, z, kOne, 29990);
    put_inert(v, x + dx, y + dy, z + dz);
    v.heat[v.at(x + dx, y + dy, z + dz)] = 30000;
    EXPECT_TRUE(same_asleep(p, v, 300)) << dx << dy << dz;
    run::Simulation s = simulate(p, v);
    steps(s, 300);
    EXPECT_GT(s.volume().heat[v.at(x, y, z)], 29990) << "nothing happened: the test would prove nothing";
  }
}

// One drop lies beside the border of two words. Its gifts cross the border, each direction alone, and its
// heat goes on beyond it.
TEST(Sleep, ADropGivesAcrossWords) {
  for (int seed = 0; seed < 150; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Parameters p = paper_showcase();
    p.seed = random.bits();
    p.flow.paper.neighbours = seed % 3 == 0 ? 4 : 8;
    p.heat.enabled = seed % 2 == 0;
    p.heat.weight_face = 0;
    p.material.melting_point = 30000;
    p.flow.paper.reheat = 20000;
    Volume start({130, 2, 5});
    put(start, random.any({63, 64, 127, 128}), 0, random.any({0, 2, 4}), 4096, 4096,
        p.heat.enabled ? 40000 : 0);
    ASSERT_TRUE(same_steps(p, start, fast_implementations().back(), sleepy(seed % 2 + 1, 0), 3));
  }
}

// The drop now lies beside walls of the next word, in a word that has none.
TEST(Sleep, ADropStopsAtTheNextWord) {
  for (int seed = 0; seed < 150; ++seed) {
    Random random(static_cast<std::uint64_t>(seed));
    Parameters p = paper_showcase();
    p.seed = random.bits();
    p.flow.paper.neighbours = seed % 3 == 0 ? 4 : 8;
    Volume start({194, 1, 5});
    const int x = random.any({64, 127});
    for (int walls = random.between(1, 2); walls > 0; --walls)
      put_inert(start, x == 64 ? 63 : 128, 0, random.between(1, 3));
    put(start, x, 0, 2, 4096, 4096);
    ASSERT_TRUE(same_steps(p, start, fast_implementations().back(), sleepy(1, 0), 3));
  }
}

// Under the viscous law, a run that comes to rest may reach liquid above it in the next step.
TEST(Sleep, ARunGrowsAfterItRests) {
  Volume start({3, 8, 3});
  fill_inert(start, whole(start.grid));
  for (int y = 0; y < 8; ++y) {
    constexpr int kAmounts[8] = {7192, 1000, 5000};
    start.inert.set(1, y, 1, false);
    put(start, 1, y, 1, kAmounts[y]);
  }
  ASSERT_TRUE(same_asleep(viscous(0.1), start, 6));
}

// Under the viscous law, liquid hangs full beside a run. As it is drained, there is room for more.
TEST(Sleep, ADrainMakesRoom) {
  Parameters p = viscous(0.5);
  p.flow.fall.hang = 65535;
  p.drains.push_back({{{40, 24, 24}, 1}, 500, 5, 6});
  Volume start({4, 4, 3});
  fill_inert(start, whole(start.grid));
  for (const int x : {1, 2}) {
    start.inert.set(x, 1, 1, false);
    put(start, x, 1, 1, 4096);
  }
  put(start, 2, 0, 1, 0);
  start.inert.set(2, 0, 1, false);
  ASSERT_TRUE(same_asleep(p, start, 12));
}

// Under the viscous law, liquid rests by its yield, level with the upper faces of a floating slab. The slab
// melts one tile below. The cells on it then show no ground, though nothing else in their tile has changed.
TEST(Sleep, GroundThatMeltsIsShownNoMore) {
  Parameters p = viscous(0.3, 0.125);
  p.heat = with_drops(rule::Law::viscous).heat;
  p.heat.air_temperature.assign(16, 40000);
  p.material.melting_point = 30000;
  for (const int first : {0, 256}) {  // in the first group of words, and in another
    const Grid grid{first + 6, 16, 2};
    Volume start(grid);
    fill_inert(start, {0, 0, 1, grid.x, 8, 2});
    for (int x = first; x < grid.x; ++x) put_solid(start, x, 7, 0, 4096, 20000);
    put(start, first + 3, 8, 1, 1024, 0, 40000);
    run::Simulation reference = simulate(p, start);
    int melted = 0;
    for (; reference.volume().solid.count() > 0 && melted < 30; ++melted) {
      if (reference.volume().heat[start.at(first + 3, 7, 0)] <= 30000 - 4096) {  // its bed sinks from then on
        ASSERT_EQ(amount_at(reference, first + 3, 8, 1), 1024) << "rests while the slab is there";
      }
      reference.step();
    }
    ASSERT_GT(melted, 3);
    ASSERT_LT(amount_at(reference, first + 3, 8, 1), 1024) << "flows when it has melted";
    ASSERT_TRUE(same_asleep(p, start, melted + 2)) << first;
  }
}

// A dam breaks behind a wall, so that steps need fewer sub-steps. Beside it a pool sleeps, and shows values
// that fit the former number of sub-steps. Then a vent makes a part of it give across words.
TEST(Sleep, SleepersShowWhatFitsTheSubsteps) {
  Parameters p = viscous(0.3);
  p.flow.viscous.substeps = 0;
  Volume start({194, 6, 1});
  fill(start, {0, 0, 0, 3, 6, 1}, kOne);
  for (int y = 0; y < 6; ++y) put_inert(start, 60, y, 0);
  fill(start, {61, 0, 0, 194, 1, 1}, kOne);
  p.vents = {{.region = {{16 * 127 + 8, 8, 8}, 1}, .rate = 4096, .energy = 0, .from = 40}};
  for (const int threads : {1, 2})
    ASSERT_TRUE(same_steps(p, start, fast_implementations().back(), sleepy(threads, 0), 50));
}

}  // namespace
}  // namespace voxmelt::parallel
