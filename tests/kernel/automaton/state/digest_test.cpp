// The digest is compared with the page's formula (docs/automaton.md, section 13), written again from scratch.
#include "kernel/automaton/state/digest.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <set>

#include "kernel/automaton/state/fields.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::state {
namespace {

using worlds::put;

std::uint64_t m(std::uint64_t v) {
  v ^= v >> 30;
  v *= 13787848793156543929u;  // 0xBF58476D1CE4E5B9
  v ^= v >> 27;
  v *= 10723151780598845931u;  // 0x94D049BB133111EB
  return v ^ v >> 31;
}

std::uint64_t by_the_page(const Volume& v) {
  std::uint64_t sum = 0;
  for (int x = v.grid.x; x-- > 0;)  // any order
    for (int z = 0; z < v.grid.z; ++z)
      for (int y = v.grid.y; y-- > 0;) {
        const auto i = static_cast<std::uint64_t>((z * v.grid.y + y) * v.grid.x + x);
        const state::Slot at = v.at(x, y, z);
        std::uint64_t packed = v.amount[at] + 65536ull * v.energy[at] + 4294967296ull * v.heat[at];
        if (v.solid.test(x, y, z)) packed += 281474976710656ull;
        if (v.liquid.test(x, y, z)) packed += 562949953421312ull;
        if (v.inert.test(x, y, z)) packed += 1125899906842624ull;
        if (packed != 0) sum += m(packed + 11400714819323198485u * (i + 1));
      }
  return sum;
}

TEST(Digest, KnownValues) {
  Volume v(Grid{2, 2, 2});
  EXPECT_EQ(digest(v), 0u) << "nothing adds nothing";
  // The finaliser is splitmix64's: its first output from state 0 is m(0x9E3779B97F4A7C15).
  EXPECT_EQ(mixed_bits(0x9E3779B97F4A7C15u), 0xE220A8397B1DCDAFu);
  EXPECT_EQ(cell_digest(0, 0), 0u);
  EXPECT_EQ(cell_digest(1, 5), m(5 + 2 * 0x9E3779B97F4A7C15u));
  put(v, 1, 0, 1, 4096, 17, 300);
  // i = 5, packed = 4096 + 17 2^16 + 300 2^32 + 2^49
  EXPECT_EQ(digest(v), m(0x0002012C00111000u + 6 * 0x9E3779B97F4A7C15u));
}

Volume random_volume(Grid g, std::uint64_t seed) {
  worlds::Random random(seed);
  Volume v(g);
  worlds::for_each(worlds::whole(g), [&](int x, int y, int z) {
    const std::int32_t kind = random.below(4);
    if (kind == 1) worlds::put_solid(v, x, y, z, random.between(1, 4096), random.below(65536));
    if (kind == 2) worlds::put_inert(v, x, y, z, random.below(4097));
    if (kind == 3) {
      const std::int32_t a = random.between(1, 65535);
      put(v, x, y, z, a, random.below(a + 1), random.below(65536));
    }
  });
  return v;
}

TEST(Digest, IsTheSumOfThePage) {
  for (const Grid g : {Grid{1, 1, 1}, {2, 3, 5}, {63, 3, 2}, {64, 2, 2}, {65, 2, 3}, {1, 65, 1}, {1, 1, 64}})
    for (std::uint64_t seed = 0; seed < 4; ++seed) {
      const Volume v = random_volume(g, seed);
      EXPECT_EQ(digest(v), by_the_page(v));
    }
}

TEST(Digest, AnyDifferenceInAnyCellShows) {
  const Grid g{5, 4, 3};
  const Volume start = random_volume(g, 9);
  std::set<std::uint64_t> seen{digest(start)};
  std::size_t states = 1;
  const auto differs = [&](const Volume& v) {
    ++states;
    seen.insert(digest(v));
  };
  worlds::for_each(worlds::whole(g), [&](int x, int y, int z) {
    for_each_field([&](const auto& row) {
      if (row.optional) return;
      const std::uint32_t value = value_at(start.*row.column, x, y, z);
      for (const int bit : {0, 7, 15}) {
        if (bit >= row.bits) continue;
        Volume v = start;
        set_value(v.*row.column, x, y, z, value ^ 1u << bit);
        differs(v);
      }
    });
  });
  EXPECT_EQ(seen.size(), states);
}

TEST(Digest, EqualCellsInOtherPlacesDiffer) {
  std::set<std::uint64_t> seen;
  const Grid g{6, 5, 4};
  worlds::for_each(worlds::whole(g), [&](int x, int y, int z) {
    Volume v(g);
    put(v, x, y, z, 4096);
    seen.insert(digest(v));
  });
  EXPECT_EQ(seen.size(), g.cells());
}

}  // namespace
}  // namespace voxmelt::state
