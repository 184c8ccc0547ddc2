// The SIMD kernels of source, heat and melt agree with the reference, phase by phase, in every bit of every
// field and every term of the ledgers. Asleep, they agree with themselves awake.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/automaton/rule/heat.h"
#include "kernel/engine/scalar/reference.h"
#include "tests/kernel/engine/simd/heat_compare.h"
#include "tests/rounds.h"

namespace voxmelt::simd {
namespace {

using step::Phase;

class Heat : public testing::TestWithParam<cpu::InstructionSetRow> {
 protected:
  void SetUp() override {
    if (!cpu::supported(GetParam().set)) GTEST_SKIP() << "not on this processor";
  }
};

struct World {
  Parameters parameters;
  Volume volume;
  std::uint32_t first = 0;  // step
  int steps = 0;
  bool flows = false;  // the reference runs the flow between the steps
};

// Returns the share of tiles that slept.
double run_both(const cpu::InstructionSet set, World world, Random& random, bool sleeps) {
  const Parameters& p = world.parameters;
  Volume expected = world.volume, v = std::move(world.volume);
  const step::Irradiance irradiance = hostile_irradiance(random, v, sleeps);
  const step::Irradiance* light = p.heat.radiation ? &irradiance : nullptr;
  scalar::Reference reference(p, v.grid);
  state::Ledger books;

  std::vector<int> cuts;
  for (int z = 1; z < v.grid.z; ++z)
    if (random.one_in(3)) cuts.push_back(z);
  HeatDriver driver(kernels(set, p), v, random.any({0, 1, 3, 12}), cuts);
  const View& view = driver.view();
  Books own;
  TileSet restless(view, true), last_changed(view, true), for_melt(view, true);
  std::int64_t worked = 0, tiles = 0;

  for (std::uint32_t s = world.first; s < world.first + static_cast<std::uint32_t>(world.steps); ++s) {
    const Step step{&p, s, static_cast<std::uint32_t>(rule::dither(s)), nullptr,
                    light != nullptr ? light->data() : nullptr};
    TileSet changed(view, false);
    const auto compare = [&](const char* phase, const Volume& before) {
      ASSERT_TRUE(expected == v) << phase << ", step " << s << ", " << difference(expected, v);
      ASSERT_EQ(terms(books), terms(own)) << phase << ", step " << s;
      ASSERT_NO_FATAL_FAILURE(expect_reported(view, before, v, changed)) << phase << ", step " << s;
    };
    const Volume at_begin = v;
    reference.run(Phase::source, step::Moment(s), light, expected, books);
    const TileSet everywhere(view, true);
    run_sources(view, step, everywhere.slice(0), changed.data(), view.tile_rows(), own);
    compare("source", at_begin);
    for_melt.add(changed);

    TileSet work(view, !sleeps);
    work.add_around(last_changed);
    work.add_around(changed);
    work.add(restless);
    worked += work.count();
    tiles += work.size();
    restless = TileSet(view, false);
    reference.run(Phase::heat, step::Moment(s), light, expected, books);
    driver.heat(step, work, changed, restless, for_melt, own);
    compare("heat", at_begin);

    TileSet melting(view, !sleeps), melted(view, false);
    melting.add(for_melt);
    reference.run(Phase::melt, step::Moment(s), light, expected, books);
    driver.melt(step, melting, melted, own);
    changed.add(melted);
    for_melt = melted;
    compare("melt", at_begin);
    if (testing::Test::HasFatalFailure()) break;

    if (world.flows) {
      state::Ledger unused;
      for (const Phase phase : {Phase::gravity, Phase::spread, Phase::excess})
        reference.run(phase, step::Moment(s), light, expected, unused);
      const TileSet moved = tiles_between(view, expected, v);
      changed.add(moved);
      for_melt.add(moved);
      std::copy_n(expected.amount.data(), expected.amount.layout().cells(), v.amount.data());
      std::copy_n(expected.energy.data(), expected.amount.layout().cells(), v.energy.data());
      std::copy_n(expected.heat.data(), expected.amount.layout().cells(), v.heat.data());
      std::copy_n(expected.liquid.data(), expected.liquid.words().size(), v.liquid.data());
    }
    last_changed = changed;
  }
  return 1 - static_cast<double>(worked) / static_cast<double>(tiles);
}

World hostile_world(Random& random, Grid grid, int steps) {
  World world;
  world.parameters =
      hostile_parameters(random, random.one_in(3) ? rule::Law::viscous : rule::Law::paper, grid);
  world.parameters.heat.enabled = true;
  world.volume = hostile_volume(random, world.parameters, grid);
  if (random.one_in(2)) thin_out(random, world.volume);
  world.first = static_cast<std::uint32_t>(random.any({0, 65533, random.below(65536)}));
  world.steps = steps;
  return world;
}

TEST_P(Heat, EveryStateAsTheReference) {
  Random random(11);
  const auto check = [&](Grid grid, int cases) {
    for (int i = 0; i < cases; ++i) {
      SCOPED_TRACE(std::to_string(grid.x) + " x " + std::to_string(grid.y) + " x " + std::to_string(grid.z) +
                   ", case " + std::to_string(i));
      run_both(GetParam().set, hostile_world(random, grid, 3), random, false);
      ASSERT_FALSE(HasFatalFailure());
    }
  };
  for (const int n : {1, 2, 31, 32, 33, 63, 64, 65, 127, 129}) {
    check({n, 5, 4}, 24);
    check({n, 1, 3}, 6);
    check({n, 9, 1}, 6);
  }
  check({3, 33, 4}, 10);
  check({5, 2, 17}, 10);
  check({200, 12, 7}, 10);
}

// The block of matter has few holes or none. In its tiles and words every pair counts. It has amounts of full
// cells and others, and heats far apart.
TEST_P(Heat, DenseMatter) {
  Random random(12);
  for (int i = 0; i < 40; ++i) {
    World world = hostile_world(random, {random.any({64, 128, 150, 192}), random.any({7, 10, 18}), 5}, 3);
    world.parameters.vents.clear();
    world.parameters.drains.clear();
    const bool far = random.one_in(2), full = random.one_in(2), holes = random.one_in(2);
    const std::int32_t large = random.any({4096, 36863, 36864, 65535});
    for_each(whole(world.volume.grid), [&](int x, int y, int z) {
      world.volume.inert.set(x, y, z, false);
      world.volume.solid.set(x, y, z, false);
      put(world.volume, x, y, z, 0);
      if (holes && random.one_in(300)) return;
      const std::int32_t heat = far ? random.any({0, 65535}) : 30000 + random.below(9);
      const std::int32_t amount = full ? large : random.between(1, large);
      if (random.one_in(3))
        put_solid(world.volume, x, y, z, amount, heat);
      else
        put(world.volume, x, y, z, amount, 0, heat);
    });
    SCOPED_TRACE(i);
    run_both(GetParam().set, std::move(world), random, false);
    ASSERT_FALSE(HasFatalFailure());
  }
}

// Makes few bodies, of few temperatures, in a large room. The weights are so small that hardly a step moves a
// unit.
World sleepy_world(Random& random, Grid grid) {
  World world = hostile_world(random, grid, 24);
  Parameters& p = world.parameters;
  const auto small = [&](int most) {
    return static_cast<std::uint16_t>(random.any({0, 1, 60, most / 4, most}));
  };
  p.heat.weight_face = small(10922);
  p.heat.weight_edge = small(5461);
  p.heat.weight_corner = small(3640);
  p.heat.convection = small(32767);
  p.heat.air_exchange = small(43690);
  p.heat.air = random.one_in(4);
  p.heat.radiation = random.one_in(4);
  p.material.melting_point = 30000;
  p.material.latent_heat = random.any<rule::Temperature>({0, 0, 500});
  world.flows = random.one_in(3);
  world.first = random.any<std::uint32_t>({0, 65520, 43680, 21840});
  world.volume = Volume(grid);
  const std::int32_t common = random.any({100, 30000, 30400, 65535});
  for (int n = random.between(2, 5); n > 0; --n) {
    const int x = random.below(grid.x), y = random.below(grid.y), z = random.below(grid.z);
    const std::int32_t amount = random.any({1, 4096, 5000});
    const bool solid = random.one_in(2);
    const Box box{x,
                  y,
                  z,
                  std::min(grid.x, x + random.between(1, 40)),
                  std::min(grid.y, y + random.between(1, 5)),
                  std::min(grid.z, z + random.between(1, 3))};
    if (p.heat.walls && random.one_in(2)) {
      put_inert(world.volume, x, y, z);
      world.volume.heat[world.volume.at(x, y, z)] = static_cast<std::uint16_t>(common);
      continue;
    }
    const std::int32_t warmest = common + random.any({0, 0, 0, -1, -40}), layer = random.any({0, 0, 1});
    for_each(box, [&](int cx, int cy, int cz) {
      world.volume.solid.set(cx, cy, cz, false);
      world.volume.inert.set(cx, cy, cz, false);
      const std::int32_t heat = warmest - layer * (cy % 3);
      if (solid)
        put_solid(world.volume, cx, cy, cz, amount, heat);
      else
        put(world.volume, cx, cy, cz, amount, 0, heat);
    });
  }
  return world;
}

TEST_P(Heat, SleepChangesNothing) {
  Random random(13);
  double slept = 0;
  const int cases = rounds(200);
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE(i);
    const Grid grid{random.any({65, 128, 190}), random.any({6, 17}), random.any({4, 9})};
    slept += run_both(GetParam().set, sleepy_world(random, grid), random, true);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(slept / cases, 0.5) << "of the tiles should sleep";
}

// The same holds if all is matter, of one heat but for a few cells.
TEST_P(Heat, SleepChangesNothingInDenseMatter) {
  Random random(15);
  double slept = 0;
  const int cases = rounds(40);
  for (int i = 0; i < cases; ++i) {
    SCOPED_TRACE(i);
    const Grid grid{64 * random.between(1, 10), random.any({7, 10, 18}), random.any({2, 4})};
    World world = sleepy_world(random, grid);
    world.flows = false;
    const std::int32_t common = random.any({29990, 30000, 30400, 40000});
    const std::int32_t amount = random.any({4096, 4096, 5000}), solid = random.any({1, 3, 100});
    const auto matter = [&](int x, int y, int z, std::int32_t heat) {
      if (random.one_in(solid))
        put_solid(world.volume, x, y, z, amount, heat);
      else
        put(world.volume, x, y, z, amount, 0, heat);
    };
    world.volume = Volume(grid);
    for_each(whole(grid), [&](int x, int y, int z) { matter(x, y, z, common); });
    for (int n = random.any({2, 8, 20}); n > 0; --n) {
      const int x = 64 * random.below(grid.x / 64) + random.any({0, 63, random.below(64)});
      const int y = random.one_in(2) ? 3 : random.below(grid.y), z = random.below(grid.z);
      world.volume.solid.set(x, y, z, false);
      if (random.one_in(2))
        put(world.volume, x, y, z, 0);
      else
        matter(x, y, z, common + random.any({1, 9, 40, 9000, -40}));
    }
    slept += run_both(GetParam().set, std::move(world), random, true);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(slept / cases, 0.2) << "of the tiles should sleep";
}

// Conduction runs in tiles chosen at random, each row's side by side. It is right whatever the tiles beside
// them hold.
TEST_P(Heat, AnyTilesOfDenseMatter) {
  Random random(16);
  for (int i = 0; i < 60; ++i) {
    SCOPED_TRACE(i);
    const Grid grid{64 * random.between(1, 6), random.any({7, 10, 18}), 4};
    Parameters p;
    p.heat.enabled = true;
    p.heat.weight_face = 10922;
    p.material.latent_heat = random.any<rule::Temperature>({0, 20000});
    Volume expected(grid);
    for_each(whole(grid), [&](int x, int y, int z) {
      if (!random.one_in(2000)) put_solid(expected, x, y, z, kOne, random.below(65536));
    });
    Volume v = expected;
    state::Ledger unused;
    scalar::Reference(p, grid).run(Phase::heat, step::Moment(3), nullptr, expected, unused);

    HeatDriver driver(kernels(GetParam().set, p), v, random.any({0, 1, 3, 12}), {2});
    const View& view = driver.view();
    TileSet work(view, false), changed(view, false), restless(view, false), hot(view, false);
    for (int z = 0; z < grid.z; ++z)
      for (int r = 0; r < view.tile_rows(); ++r) {
        const int first = random.below(view.words), last = random.between(first, view.words - 1);
        work.slice(z)[r] = (TileRow{2} << last) - (TileRow{1} << first);
      }
    const TileSet asked = work;
    Books books;
    driver.heat({&p, 3, static_cast<std::uint32_t>(rule::dither(3)), nullptr, nullptr}, work, changed,
                restless, hot, books);
    for_each(whole(grid), [&](int x, int y, int z) {
      if ((asked.slice(z)[y >> view.tile_shift] >> (x / 64) & 1) == 0) return;
      ASSERT_EQ(v.heat[v.at(x, y, z)], expected.heat[v.at(x, y, z)]) << x << ", " << y << ", " << z;
    });
    ASSERT_FALSE(HasFatalFailure());
  }
}

// Every difference of two temperatures occurs in pairs of cells along an axis. All else is air.
TEST_P(Heat, EveryDifference) {
  Random random(14);
  for (int axis = 0; axis < 3; ++axis) {
    const Grid grid = axis == 0 ? Grid{3072, 256, 1} : axis == 1 ? Grid{2048, 384, 1} : Grid{2048, 256, 2};
    const int dx = axis == 0, dy = axis == 1, dz = axis == 2;
    Volume start(grid);
    std::vector<state::Slot> first, second;
    std::int32_t d = -65535;
    for_each(whole(grid), [&](int x, int y, int z) {
      const int gap_x = axis == 0 ? 3 : 2, gap_y = axis == 1 ? 3 : 2;
      if (x % gap_x != 0 || y % gap_y != 0 || z != 0 || x + dx >= grid.x || y + dy >= grid.y) return;
      if (d > 65535) return;
      const std::int32_t base = random.below(65536 - std::abs(d));
      put(start, x, y, z, kOne, 0, d < 0 ? base - d : base);
      put(start, x + dx, y + dy, z + dz, kOne + 1, 0, d < 0 ? base : base + d);
      first.push_back(start.at(x, y, z));
      second.push_back(start.at(x + dx, y + dy, z + dz));
      ++d;
    });
    ASSERT_EQ(d, 65536) << "every difference has its pair";
    for (int i = 0; i < 30; ++i) {
      Parameters p;
      p.heat.enabled = true;
      p.heat.weight_face = static_cast<std::uint16_t>(random.any({1, 10922, 8192, random.between(1, 10922)}));
      const std::int32_t dither = random.any({0, 1, 32768, 65535, random.below(65536)});
      Volume v = start;
      HeatDriver driver(kernels(GetParam().set, p), v, 3, {});
      TileSet work(driver.view(), true), changed(driver.view(), false), restless(driver.view(), false),
          hot(driver.view(), false);
      Books books;
      driver.heat({&p, 0, static_cast<std::uint32_t>(dither), nullptr, nullptr}, work, changed, restless, hot,
                  books);
      const std::int32_t part = (dither + 65536 * axis / 3) % 65536;
      for (std::size_t k = 0; k < first.size(); ++k) {
        const std::int32_t a = start.heat[first[k]], b = start.heat[second[k]];
        const std::int32_t flow = rule::conducted(a, b, p.heat.weight_face, part);
        ASSERT_EQ(v.heat[first[k]], a + flow) << b - a << " x " << p.heat.weight_face << ", D " << part;
        ASSERT_EQ(v.heat[second[k]], b - flow) << b - a << " x " << p.heat.weight_face << ", D " << part;
      }
    }
  }
}

// The slice is so large that a sum over it would overflow 32 bits. Every cell loses, and none is full.
TEST_P(Heat, BooksOfManyCells) {
  const Grid grid{4096, 520, 2};
  Volume start(grid);
  for_each(whole(grid),
           [&](int x, int y, int z) { put(start, x, y, z, kOne + 1 + z, 0, z == 0 ? 1000 : 900); });
  Parameters p;
  p.heat.enabled = true;
  p.heat.weight_face = 10922;
  Volume v = start;
  HeatDriver driver(kernels(GetParam().set, p), v, 3, {});
  TileSet work(driver.view(), true), changed(driver.view(), false), restless(driver.view(), false),
      hot(driver.view(), false);
  Books books;
  driver.heat({&p, 0, 0, nullptr, nullptr}, work, changed, restless, hot, books);
  std::int64_t conducted = 0;
  for_each(whole(grid), [&](int x, int y, int z) {
    const state::Slot i = v.at(x, y, z);
    conducted += std::int64_t{v.amount[i]} * (int{v.heat[i]} - int{start.heat[i]});
  });
  EXPECT_EQ(books.heat.conducted, conducted);
}

INSTANTIATE_TEST_SUITE_P(Sets, Heat, testing::ValuesIn(cpu::kInstructionSets), [](const auto& set) {
  std::string name(set.param.name);
  std::erase(name, '.');
  return name;
});

}  // namespace
}  // namespace voxmelt::simd
