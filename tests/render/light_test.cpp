// The light of every instruction set, told and untold, agrees with plain loops over the rule.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/engine/cpu/workers.h"
#include "render/light/light_matter.h"
#include "render/light/light_volume.h"
#include "tests/kernel/worlds.h"
#include "tests/render/plain_light.h"

namespace voxmelt {
namespace {

using picture::Vector;
using worlds::Random;

// Returns the loops that this processor can run.
std::vector<std::pair<std::string, render::LightLoops>> all_loops() {
  using enum cpu::InstructionSet;
  std::vector<std::pair<std::string, render::LightLoops>> all;
#if defined(__aarch64__)
  all.emplace_back("neon", render::light_loops_for<cpu::ArchOf<neon>>());
#else
  if (cpu::supported(sse42)) all.emplace_back("sse4.2", render::light_loops_for<cpu::ArchOf<sse42>>());
  if (cpu::supported(avx2)) all.emplace_back("avx2", render::light_loops_for<cpu::ArchOf<avx2>>());
#endif
  return all;
}

std::uint8_t any_byte(Random& random) {
  return static_cast<std::uint8_t>(random.one_in(2) ? 0 : random.one_in(4) ? 255 : random.below(256));
}

// Changes a box to noise, or to one value.
void change(render::LightPlane& plane, Random& random, int most) {
  const auto side = [&](std::int64_t count) {
    const int low = random.below(static_cast<int>(count));
    return std::pair<std::int64_t, std::int64_t>{
        low, std::min<std::int64_t>(count, low + random.between(1, most))};
  };
  const auto x = side(plane.count.x), y = side(plane.count.y), z = side(plane.count.z);
  const bool noise = random.one_in(2);
  const std::uint8_t value = any_byte(random);
  for (std::int64_t k = z.first; k < z.second; ++k)
    for (std::int64_t j = y.first; j < y.second; ++j)
      for (std::int64_t i = x.first; i < x.second; ++i)
        plane.cells[plane.index(i, j, k)] = noise ? any_byte(random) : value;
}

render::LightMatter any_matter(Random& random, Vector count, bool glow) {
  render::LightMatter matter{{count, 0}, {}};
  if (glow) matter.emission = matter.density;
  for (int i = random.below(4); i > 0; --i) {
    change(matter.density, random, 20);
    if (glow) change(matter.emission, random, 8);
  }
  return matter;
}

// Each axis may dominate. There are ties, negative components, and components of 0.
Vector any_direction(Random& random) {
  const auto component = [&]() -> std::int64_t {
    return random.one_in(4) ? 0 : random.one_in(4) ? 1 - 2 * random.below(2) : random.between(-20, 20);
  };
  Vector vector{component(), component(), component()};
  if (vector == Vector{}) vector.y = 1;
  if (random.one_in(5)) vector = {vector.x, vector.x, random.one_in(2) ? vector.x : vector.z};
  if (vector == Vector{}) vector.z = -1;
  return picture::unit_of(vector * (1 << 20));
}

void expect_plain(const render::LightVolume& light, const render::LightMatter& matter, Vector to_light) {
  const std::vector<render::LightBytes> plain = test::plain_light(matter, to_light);
  ASSERT_EQ(light.cells().size(), plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    if (light.cells()[i] == plain[i]) continue;
    const auto& is = light.cells()[i];
    FAIL() << "cell " << i << ": lamp " << int{plain[i].lamp} << ", is " << int{is.lamp} << "; from +x "
           << int{plain[i].open[0]} << ", is " << int{is.open[0]} << "; glow from +x "
           << int{plain[i].glow[0]} << ", is " << int{is.glow[0]};
  }
}

TEST(Light, AllSweepsToldAndUntold) {
  for (const auto& [name, loops] : all_loops())
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
      Random random(seed * 77 + 5);
      const auto side = [&] { return std::int64_t{random.one_in(6) ? 1 : random.between(1, 38)}; };
      const Vector count{side(), side(), side()};
      Vector to_light = any_direction(random);
      bool glow = random.one_in(2);
      render::LightMatter matter = any_matter(random, count, glow);
      render::LightVolume light;
      cpu::Workers workers(static_cast<int>(1 + seed % 3));
      for (int round = 0; round < 6; ++round) {
        light.update(matter, to_light, 1, workers, loops);
        expect_plain(light, matter, to_light);
        if (testing::Test::HasFailure()) FAIL() << name << ", seed " << seed << ", round " << round;
        EXPECT_FALSE(light.update(matter, to_light, 1, workers, loops)) << "nothing changed";
        for (int i = random.below(3); i > 0; --i) change(matter.density, random, random.any({1, 2, 8}));
        if (glow && random.one_in(2)) change(matter.emission, random, 3);
        if (random.one_in(5)) to_light = any_direction(random);
        if (random.one_in(9)) {
          glow = !glow;
          matter = any_matter(random, count, glow);
        }
      }
    }
}

// A wall of every density makes the blends reach both ends of their ranges.
TEST(Light, FullLossBetweenCells) {
  for (const auto& [name, loops] : all_loops())
    for (const std::int64_t lean : {0, 1, 64, 127, 128, 200}) {
      const Vector count{19, 17, 18}, to_light = picture::unit_of({lean << 12, 200 << 12, -lean << 11});
      render::LightMatter matter{{count, 255}, {}};
      for (std::size_t i = 0; i < matter.density.cells.size(); i += 97) matter.density.cells[i] = 183;
      for (std::size_t i = 0; i < matter.density.cells.size() / 3; ++i) matter.density.cells[i * 2] = 12;
      cpu::Workers workers(1);
      render::LightVolume light;
      light.update(matter, to_light, 1, workers, loops);
      expect_plain(light, matter, to_light);
      if (testing::Test::HasFailure()) FAIL() << name << ", lean " << lean;
    }
}

// The light is that of a field over ground, changed brick by brick.
TEST(Light, SourcesToldAndUntold) {
  for (const auto& [name, loops] : all_loops())
    for (std::uint64_t seed = 0; seed < 24; ++seed) {
      Random random(seed * 31 + 9);
      // One grid is so long that a cell of light is 4 cells wide, and one is a row of nine cells.
      const state::Grid grid =
          seed == 20   ? state::Grid{3000, 60, 31}
          : seed == 21 ? state::Grid{9, 1, 1}
                       : state::Grid{random.between(1, 50), random.between(1, 40), random.between(1, 45)};
      if (seed == 20 && name != "sse4.2") continue;
      state::Volume volume(grid);
      volume.changed.follow(grid);
      scene::Look field_look;
      field_look.glow = random.one_in(2);
      field_look.smooth = random.any({0, 1, 3});
      picture::Look look;
      look.glow = field_look.glow;
      look.glow_cold = random.below(30000);
      look.glow_hot = random.between(20000, 65536);
      if (random.one_in(2)) look.clear = {random.below(3), random.between(1, 1200), 900};
      std::vector<std::int32_t> ground;
      if (random.one_in(2))
        for (int i = 0; i < grid.x * grid.z; ++i) ground.push_back(random.below(grid.y * 4096 + 1));
      render::DensityField field;
      render::LightSources sources;
      for (int round = 0; round < 6; ++round) {
        field.update(volume, field_look);
        const render::LightMatter before = sources.matter();
        const bool changed =
            sources.update(field, ground, look, round == 0 ? nullptr : &field.refreshed(), loops);
        const render::LightMatter plain = test::plain_light_matter(field, ground, look);
        ASSERT_EQ(sources.matter().density.cells, plain.density.cells)
            << name << ", seed " << seed << ", round " << round;
        ASSERT_EQ(sources.matter().emission.cells, plain.emission.cells)
            << name << ", seed " << seed << ", round " << round;
        if (round > 0) {
          EXPECT_EQ(changed, before.density.cells != plain.density.cells ||
                                 before.emission.cells != plain.emission.cells);
        }
        volume.changed.new_version();
        for (int edits = random.below(40); edits > 0; --edits) {
          const int x = random.below(grid.x), y = random.below(grid.y), z = random.below(grid.z),
                    kind = random.below(5);
          const state::Slot at = volume.at(x, y, z);
          volume.solid.set(x, y, z, kind == 1);
          volume.liquid.set(x, y, z, kind == 2 || kind == 3);
          volume.inert.set(x, y, z, kind == 4);
          volume.amount[at] = static_cast<std::uint16_t>(kind % 4 == 0 ? 0 : 1 + random.below(6000));
          volume.heat[at] = static_cast<std::uint16_t>(kind % 4 == 0 ? 0 : random.below(65536));
          volume.changed.mark(state::ChangedBricks::kMatter, std::uint64_t{1} << x / 64 % 64, y / 8, z / 8);
        }
        for (int edits = random.below(4); edits > 0 && !ground.empty(); --edits)
          ground[static_cast<std::size_t>(random.below(static_cast<int>(ground.size())))] =
              random.below(grid.y * 4096 + 1);
        if (random.one_in(6)) look.glow_hot = random.between(20000, 65536);
        if (random.one_in(6) && !look.glow) look.clear[1] = random.between(1, 1200);
        if (random.one_in(9)) ground.clear();
      }
    }
}

}  // namespace
}  // namespace voxmelt
