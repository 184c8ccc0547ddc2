// The viscous law's kernels of every instruction set agree with the reference after every phase. They give
// the same state and the same books, whatever sleeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kernel/automaton/state/difference.h"
#include "tests/kernel/engine/scalar/hostile.h"
#include "tests/kernel/engine/simd/viscous_driver.h"
#include "tests/rounds.h"

namespace voxmelt::simd {
namespace {

using worlds::Grid;
using worlds::Parameters;
using worlds::Random;
using worlds::Volume;
using Way = ViscousDriver::Way;

std::vector<cpu::InstructionSet> sets() {
  std::vector<cpu::InstructionSet> found;
  for (const cpu::InstructionSetRow& one : cpu::kInstructionSets)
    if (cpu::supported(one.set)) found.push_back(one.set);
  return found;
}

std::string difference(const Volume& expected, const Volume& actual) {
  if (expected == actual) return {};
  const auto found = state::first_difference(expected, actual);
  return found ? text_of(*found) : "the padding";
}

std::string digits(state::Sum value) { return state::to_string(value); }

// Runs the reference, and kernels in each way, side by side. Calls `after(way, phase, step, driver)`, and
// returns false at the first difference.
template <class After>
bool same(const Parameters& parameters, const Volume& start, const std::vector<Way>& ways,
          std::uint32_t steps, After&& after) {
  scalar::Reference reference(parameters, start.grid);
  Volume expected = start;
  state::Ledger books = state::Ledger::open(start);
  struct Other {
    ViscousDriver driver;
    Volume volume;
    state::Ledger books;
  };
  std::vector<Other> others;
  others.reserve(ways.size());
  for (const Way& way : ways) others.push_back({ViscousDriver(parameters, start.grid, way), start, books});

  for (std::uint32_t step = 0; step < steps; ++step) {
    step::Moment moment(step, 0, scalar::count_substeps(parameters, expected));
    for (const step::Phase phase : step::phase_order(rule::Law::viscous, moment.substeps)) {
      reference.run(phase, moment, nullptr, expected, books);
      for (std::size_t i = 0; i < ways.size(); ++i) {
        Other& other = others[i];
        other.driver.run(phase, moment, other.volume, other.books);
        after(i, phase, step, other.driver);
        std::string found = difference(expected, other.volume);
        if (found.empty() && books.heat.rounded != other.books.heat.rounded)
          found = "books: expected rounded " + digits(books.heat.rounded) + ", is " +
                  digits(other.books.heat.rounded);
        if (found.empty() && !other.driver.told()) found = "a change in a tile that settle did not name";
        if (found.empty() && books.heat.expected() != other.books.heat.expected()) found = "other books";
        if (found.empty() && books.limit != other.books.limit) found = "other counts of the limit";
        if (found.empty()) continue;
        ADD_FAILURE() << "set " << static_cast<int>(ways[i].set) << ", sleep " << ways[i].sleep
                      << ", tile_shift " << ways[i].tile_shift << ", cut " << ways[i].cut << ", grid "
                      << start.grid.x << " " << start.grid.y << " " << start.grid.z << ", step " << step
                      << ", sub-step " << moment.substep << " of " << moment.substeps << ", phase "
                      << step::kPhaseNames[static_cast<std::size_t>(phase)] << ": " << found;
        return false;
      }
      if (phase == step::Phase::spread) ++moment.substep;
    }
  }
  return true;
}
bool same(const Parameters& parameters, const Volume& start, const std::vector<Way>& ways,
          std::uint32_t steps) {
  return same(parameters, start, ways, steps, [](auto&&...) {});
}

std::vector<Way> ways_for(Random& random, Grid grid, bool sleep) {
  std::vector<Way> ways;
  for (const cpu::InstructionSet set : sets())
    ways.push_back({set, sleep, random.any({0, 1, 3, 12}), random.below(grid.z)});
  return ways;
}

Parameters hostile_viscous(Random& random, Grid grid) {
  Parameters p = worlds::hostile_parameters(random, rule::Law::viscous, grid);
  p.heat.radiation = false;
  if (random.one_in(2)) p.flow.viscous.mobility = static_cast<std::uint64_t>(random.below(30000 * 4096));
  if (random.one_in(2)) p.flow.viscous.yield = static_cast<std::uint32_t>(random.below(1 << 22));
  if (random.one_in(2)) p.flow.viscous.stages_max = random.any<std::uint16_t>({2, 3, 5, 16});
  return p;
}

TEST(ViscousKernels, AreTheReferenceOnHostileStates) {
  Random random(1);
  for (const int x : {1, 2, 31, 32, 33, 63, 64, 65, 127, 129})
    for (const int y : {1, 2, 7, 8, 9, 40})
      for (int round = 0; round < rounds(4); ++round) {
        const Grid grid{x, y, random.any({1, 2, 3, 6})};
        const Parameters p = hostile_viscous(random, grid);
        Volume start = worlds::hostile_volume(random, p, grid);
        if (round % 2 == 1) worlds::thin_out(random, start);
        ASSERT_TRUE(same(p, start, ways_for(random, grid, random.one_in(2)), 8)) << "round " << round;
      }
}

// A row of columns has more than one group of words.
TEST(ViscousKernels, AreTheReferenceOnWideGrids) {
  Random random(2);
  for (const int x : {256, 257, 330, 600}) {
    const Grid grid{x, random.between(5, 12), 3};
    const Parameters p = hostile_viscous(random, grid);
    Volume start = worlds::hostile_volume(random, p, grid);
    ASSERT_TRUE(same(p, start, ways_for(random, grid, true), 8));
    worlds::thin_out(random, start);
    ASSERT_TRUE(same(p, start, ways_for(random, grid, true), 8));
  }
}

// Heads exceed 16 bits: shafts of compressed liquid, closed by a ceiling or open, stand beside low ones.
TEST(ViscousKernels, AreTheReferenceInDeepWater) {
  Random random(3);
  for (int round = 0; round < rounds(60); ++round) {
    const Grid grid{random.between(2, 70), random.any({3, 20, 300}), 3};
    Parameters p = hostile_viscous(random, grid);
    if (random.one_in(2)) p.flow.viscous.yield = static_cast<std::uint32_t>(random.below(1 << 24));
    Volume start(grid);
    const bool closed = random.one_in(2);
    for (int z = 0; z < grid.z; ++z)
      for (int x = 0; x < grid.x; ++x) {
        const int kind = random.below(4), top = random.one_in(2) ? grid.y : random.between(1, grid.y);
        for (int y = 0; y < grid.y; ++y) {
          const bool lid = y == grid.y - 1 && closed;
          if (kind == 0 && y == 0) {
            worlds::put_inert(start, x, y, z, random.below(4096));
          } else if (kind == 1 && random.one_in(20)) {
            worlds::put_solid(start, x, y, z, 4096, p.heat.enabled ? 1 : 0);
          } else if (lid) {
            worlds::put_inert(start, x, y, z);
          } else if (y < top) {
            const int a = random.any({4096, 4100, 65535, 65535, random.between(1, 65535)});
            worlds::put(start, x, y, z, a, 0, p.heat.enabled ? random.below(65536) : 0);
          }
        }
      }
    ASSERT_TRUE(same(p, start, ways_for(random, grid, random.one_in(2)), 5)) << "round " << round;
  }
}

// The columns are tall and in layers. Some keep the order of their heat, and others beside them do not. Lids
// and shelves part a few.
TEST(ViscousKernels, AreTheReferenceInLayers) {
  Random random(8);
  for (int round = 0; round < rounds(60); ++round) {
    const Grid grid{random.any({3, 33, 64, 70, 300}), random.any({4, 31, 32, 60}), 2};
    Parameters p = hostile_viscous(random, grid);
    p.heat.enabled = !random.one_in(8);
    p.flow.thermal_viscosity = random.one_in(2);
    p.vents.clear();
    Volume start(grid);
    for (int z = 0; z < grid.z; ++z)
      for (int x = 0; x < grid.x; ++x) {
        if (random.one_in(6)) continue;
        worlds::put_layers(random, start, x, z, p.heat.enabled);
        if (random.one_in(8)) worlds::put_inert(start, x, random.below(grid.y), z, 2048);
      }
    ASSERT_TRUE(same(p, start, ways_for(random, grid, random.one_in(2)), 6)) << "round " << round;
  }
}

// Heads lie on either side of the 16-bit limit. Some words have none of the greater ones.
TEST(ViscousKernels, AreTheReferenceWhereHeadsAreCut) {
  Random random(6);
  for (const bool by_word : {false, true}) {
    const Grid grid{66, 129, 3};
    const Parameters p = worlds::viscous(0.01, random.any({0, 10}));
    Volume start(grid);
    for (int z = 0; z < grid.z; ++z)
      for (int x = 0; x < grid.x; ++x) {
        int depth = by_word ? random.between(125 * 4096 + 2048, 125 * 4096 + 4000)
                            : random.between(125 * 4096, 127 * 4096);
        if (by_word && x >= 64) depth += 4096;
        for (int y = 0; y < grid.y; ++y) worlds::put(start, x, y, z, std::clamp(depth - 4096 * y, 0, 4096));
      }
    ASSERT_TRUE(same(p, start, ways_for(random, grid, true), 4));
  }
}

TEST(ViscousKernels, MaySleepOnHostileStates) {
  Random random(4);
  for (int round = 0; round < rounds(30); ++round) {
    const Grid grid{random.any({3, 64, 65, 130, 200}), random.between(2, 20), random.between(1, 6)};
    Parameters p = hostile_viscous(random, grid);
    if (random.one_in(2)) p.heat.enabled = false;
    if (random.one_in(2)) p.flow.viscous.mobility = static_cast<std::uint64_t>(random.below(200 * 4096));
    Volume start = worlds::hostile_volume(random, p, grid);
    if (round % 2 == 1) worlds::thin_out(random, start);
    ASSERT_TRUE(same(p, start, ways_for(random, grid, true), 40)) << "round " << round;
  }
}

// Blobs fall, flow and come to rest on uneven ground. Everything is asleep in the end.
TEST(ViscousKernels, MaySleepInCalmScenes) {
  Random random(5);
  for (int round = 0; round < rounds(4); ++round) {
    const Grid grid{150, 16, 8};
    // The numbers are drawn one by one, so the scenes are the same whatever the compiler.
    const double yield = random.any({0.5, 2.0}), kappa = random.any({0.1, 0.3, 2.0});
    Parameters p = worlds::viscous(kappa, yield);
    p.flow.fall.factor = static_cast<std::uint32_t>(random.any({30000, 65536}));
    p.heat.enabled = round % 2 == 1;
    Volume start(grid);
    worlds::for_each(worlds::whole(grid), [&](int x, int y, int z) {
      if (y == 0) worlds::put_inert(start, x, y, z, 2048 + 13 * x);
      if (y == 1 && (x / 9 + z / 4) % 5 == 0) worlds::put_solid(start, x, y, z, 4096, p.heat.enabled ? 9 : 0);
    });
    for (int blob = 0; blob < 3; ++blob) {
      const int x0 = random.below(130), y0 = random.between(3, 10), z0 = random.below(4);
      const int heat = p.heat.enabled ? random.below(65536) : 0;
      worlds::fill(start, {x0, y0, z0, x0 + 12, y0 + 6, z0 + 4}, 4096, 0, heat);
    }
    int first = 0, last = 0;
    const auto count = [&](std::size_t way, step::Phase phase, std::uint32_t step, ViscousDriver& driver) {
      if (way != 0 || phase != step::Phase::spread) return;
      if (step == 0) first = driver.awake();
      last = driver.awake();
    };
    std::vector<Way> ways = ways_for(random, grid, true);
    ways[0].tile_shift = 1;
    ASSERT_TRUE(same(p, start, ways, 300, count)) << "round " << round;
    EXPECT_LT(last, first / 3) << "round " << round << ": of " << first;
  }
}

// Dams break beside pools at rest. The number of sub-steps falls with their depth. Then all runs show other
// mobilities, also where everything slept.
TEST(ViscousKernels, MaySleepWhileTheSubstepsChange) {
  const Grid grid{130, 9, 4};
  Random random(8);
  int fewer = 0;
  for (int round = 0; round < rounds(8); ++round) {
    Parameters p = worlds::viscous(random.any({0.1, 0.3, 1.0}), 0.02);
    p.flow.viscous.substeps = 0;
    p.flow.viscous.substeps_max = round % 2 == 0 ? 24 : 4;
    p.flow.viscous.stages_max = round % 2 == 0 ? 1 : 16;
    Volume start(grid);
    worlds::fill(start, {0, 0, 0, 130, random.between(1, 3), 4}, 4096);
    const int dam = random.between(20, 50);
    worlds::fill(start, {dam, 0, 0, dam + random.between(4, 12), random.between(6, 9), 4}, 4096);
    std::vector<int> counted(81);
    const auto count = [&](std::size_t way, step::Phase phase, std::uint32_t step, ViscousDriver& driver) {
      if (way == 0 && phase == step::Phase::spread) counted[step] += driver.stages();
    };
    std::vector<Way> ways = ways_for(random, grid, true);
    for (Way& way : ways) way.tile_shift = 0;
    ASSERT_TRUE(same(p, start, ways, 81, count)) << "round " << round;
    fewer += counted[80] < counted[0];
  }
  EXPECT_GE(fewer, rounds(4)) << "as many as at first: nothing was tried";
}

// A string of full cells hangs by its lowest one. When the solid that this one touches melts, all of them
// follow in one step, far from anything else that changed.
TEST(ViscousKernels, FollowWhatFallsBeyondTheTilesAwake) {
  const Grid grid{8, 40, 3};
  Parameters p = worlds::viscous(0.1, 1);
  p.flow.fall.hang = 65535;
  p.heat.enabled = p.heat.air = true;
  p.heat.air_exchange = 2000;
  p.heat.air_temperature.assign(40, 40000);
  Volume start(grid);
  for (int y = 20; y < 39; ++y) worlds::put(start, 3, y, 1, 4096, 0, 40000);
  worlds::put_solid(start, 4, 20, 1, 4096, 20000);
  Random random(7);
  std::vector<Way> ways = ways_for(random, grid, true);
  for (Way& way : ways) way.tile_shift = 0;
  ASSERT_TRUE(same(p, start, ways, 60));
}

}  // namespace
}  // namespace voxmelt::simd
