// Casting only what changed gives the same bits in every cell as casting everything, call after call.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/engine/visibility/kept_rays.h"
#include "tests/kernel/engine/visibility/ray_worlds.h"

namespace voxmelt::visibility {
namespace {

// Holds a provider with the result that it gets back as it left it.
struct Kept {
  KeptRays provider;
  state::Field<std::uint16_t> result;
};

std::uint64_t all_words(const state::Layout& layout) {
  return layout.row() == 4096 ? ~std::uint64_t{0} : (std::uint64_t{1} << layout.row() / 64) - 1;
}

// Expects that each changed cell lies in a word that was told.
void expect_told(const Kept& kept, const state::Field<std::uint16_t>& before, const std::string& where) {
  const state::ChangedRows* const told = kept.provider.changed();
  if (told == nullptr) return;
  state::Field<std::uint16_t> result = kept.result;
  const state::Layout& layout = result.layout();
  for (const auto& [y, z, words] : *told) {
    ASSERT_EQ(words & ~all_words(layout), 0u) << "beyond the grid, " << where;
    for (std::uint64_t left = words; left != 0; left &= left - 1) {
      const state::Slot first = layout.at(64 * std::countr_zero(left), y, z);
      for (std::size_t x = 0; x < 64; ++x) result[first + x] = before[first + x];
    }
  }
  ASSERT_EQ(result, before) << "a change was not told, " << where;
}

void expect_all_cast(Kept& kept, const Volume& v, const rule::Heat& heat, std::uint32_t step,
                     const std::string& where) {
  state::Field<std::uint16_t> expected(v.grid);
  const std::int64_t cuts = VoxelWalkProvider().irradiance(v, heat, step, expected);
  if (kept.result.layout().cells() != expected.layout().cells())
    kept.result = state::Field<std::uint16_t>(v.grid);
  const state::Field<std::uint16_t> before = kept.result;
  ASSERT_EQ(kept.provider.irradiance(v, heat, step, kept.result), cuts) << where;
  ASSERT_EQ(kept.result, expected) << where;
  ASSERT_NO_FATAL_FAILURE(expect_told(kept, before, where));
}

enum class Event { melts, appears, lands, turns, moves, dims, rests, darkens, rays, sources, seed };

// Between two castings the world melts, and everything happens that a user can do.
TEST(KeptRays, OfHostileWorldsAreAsIfAllWereCast) {
  Random random(303);
  Casts casts;
  for (int world = 0; world < 200; ++world) {
    Volume v = hostile_world(random, hostile_grid(random));
    std::vector<Shine> shines;
    for (int n = random.between(1, 3); n > 0; --n) shines.push_back(awkward_shine(random, v.grid));
    rule::Heat heat = shone_by(shines, random.any({1, 1, 4, 16}), 7);
    Kept kept{KeptRays(std::make_unique<TwoLevelCaster>(), random.between(1, 2)), {}};
    Event event = Event::rests;
    for (int call = 0; call < 8; ++call) {
      const std::string where = "world " + std::to_string(world) + ", call " + std::to_string(call) +
                                ", event " + std::to_string(static_cast<int>(event));
      ASSERT_NO_FATAL_FAILURE(expect_all_cast(kept, v, heat, static_cast<std::uint32_t>(call), where));
      using enum Event;
      event = random.any({melts, melts, melts, melts, appears, lands, lands, turns, moves, dims, rests,
                          darkens, rays, sources, seed});
      const std::int32_t part = random.any({3, 20, 200});
      const auto n = static_cast<std::size_t>(random.below(static_cast<std::int32_t>(heat.sources.size())));
      rule::HeatSource& source = heat.sources[n];
      rule::SourceKey& key = source.keys[0];
      for_each(whole(v.grid), [&](int x, int y, int z) {
        const bool solid = v.solid.test(x, y, z), inert = v.inert.test(x, y, z);
        if (event == melts && solid && random.one_in(part)) {
          put(v, x, y, z, 0);
          v.solid.set(x, y, z, false);
        }
        if (event == appears && !solid && !inert && random.one_in(20 * part)) put_any(v, random, x, y, z);
        if (event == turns && solid != inert && random.one_in(part)) {
          v.solid.set(x, y, z, inert);
          v.inert.set(x, y, z, solid);
        }
      });
      if (event == lands) {  // opaque cells appear in one place alone
        const int x = random.below(v.grid.x), y = random.below(v.grid.y), z = random.below(v.grid.z);
        const Box piece{
            x, y, z, std::min(v.grid.x, x + 3), std::min(v.grid.y, y + 2), std::min(v.grid.z, z + 2)};
        for_each(piece, [&](int px, int py, int pz) {
          if (!v.solid.test(px, py, pz) && !v.inert.test(px, py, pz)) put_any(v, random, px, py, pz);
        });
      }
      if (event == moves) {  // or a source of another kind takes its place
        const Shine other =
            random.one_in(3) ? awkward_shine(random, v.grid) : awkward_shine(random, v.grid, source.kind);
        key = other.key;
        source.kind = other.kind;
      }
      if (event == dims) key.power = key.power / 3 + 5;
      if (event == darkens) key.power = key.power == 0 ? kRayPower : 0;
      if (event == rays) heat.rays_per_face = random.any({1, 4, 16});
      if (event == seed) ++heat.ray_seed;
      if (event == sources) {
        const Shine more = awkward_shine(random, v.grid);
        heat.sources.push_back({{more.key}, more.kind});
      }
    }
    casts += kept.provider.casts();
  }
  EXPECT_LT(casts.cast, casts.asked) << "something is remembered";
}

// A cell appears in a corner that no ray comes near, and one in the way of many.
TEST(KeptRays, CastsOnlyRaysNearWhatAppears) {
  Volume v(Grid{64, 40, 40});
  for_each({0, 0, 0, 64, 4, 40}, [&](int x, int y, int z) { put_solid(v, x, y, z); });
  const rule::Heat heat = shone_by({{16 * 8, 16 * 30, 16 * 8}}, 4);
  Kept kept{KeptRays(), {}};
  const auto cast_after = [&](int x, int y, int z) {
    put_inert(v, x, y, z);
    const std::int64_t before = kept.provider.casts().cast;
    expect_all_cast(kept, v, heat, 0, "after a cell");
    return kept.provider.casts().cast - before;
  };
  ASSERT_NO_FATAL_FAILURE(expect_all_cast(kept, v, heat, 0, "at first"));
  const std::int64_t all = kept.provider.casts().cast;
  EXPECT_GT(all, 64 * 40 * 4 - 1);
  EXPECT_EQ(cast_after(60, 39, 38), 0) << "above all rays";
  EXPECT_LT(20 * cast_after(50, 6, 30), all) << "a small shadow";
  EXPECT_GT(20 * cast_after(8, 28, 9), all) << "a large one";
}

// A ball melts from the outside, beside a wall of rock. Few rays are cast again.
TEST(KeptRays, CastsFewRaysWhileABallMelts) {
  Volume v(Grid{40, 40, 40});
  const auto from_centre = [](int x, int y, int z) {
    return (x - 20) * (x - 20) + (y - 20) * (y - 20) + (z - 20) * (z - 20);
  };
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (from_centre(x, y, z) < 200) put_solid(v, x, y, z);
  });
  fill_inert(v, {30, 0, 0, 31, 25, 40});
  const rule::Heat heat = shone_by({{700, 500, 300}, {-50, 320, 320}}, 4);
  Kept kept{KeptRays(), {}};
  Random random(8);
  for (int call = 0; call < 60; ++call) {
    ASSERT_NO_FATAL_FAILURE(expect_all_cast(kept, v, heat, 0, std::to_string(call)));
    const int cut = 200 - 2 * call;
    for_each(whole(v.grid), [&](int x, int y, int z) {
      if (from_centre(x, y, z) > cut && random.one_in(4)) v.solid.set(x, y, z, false);
    });
  }
  const Casts casts = kept.provider.casts();
  EXPECT_LT(4 * casts.cast, casts.asked) << casts.cast << " of " << casts.asked;
}

TEST(KeptRays, CastsNothingWhereNothingChanged) {
  Random random(6);
  Volume v = hostile_world(random, {64, 16, 16});
  put_solid(v, 1, 15, 1);
  Kept kept{KeptRays(), {}};
  rule::Heat heat = shone_by({{10, 16 * 40, 10}}, 16);
  expect_all_cast(kept, v, heat, 0, "first");
  const Casts first = kept.provider.casts();
  EXPECT_EQ(first.cast, first.asked);
  EXPECT_EQ(kept.provider.changed(), nullptr) << "all may be new";
  EXPECT_GT(first.asked, 0);
  heat.sources[0].keys[0].power *= 2;
  expect_all_cast(kept, v, heat, 0, "brighter");
  expect_all_cast(kept, v, heat, 0, "as before");
  ASSERT_NE(kept.provider.changed(), nullptr);
  EXPECT_TRUE(kept.provider.changed()->empty());
  EXPECT_EQ(kept.provider.casts().cast, first.cast);
  EXPECT_EQ(kept.provider.casts().asked, 3 * first.asked);
}

// One cell far away stands in the light of another, and melts. Nothing else has changed, near or far. The
// volume tells in which brick it was, and nothing of the others.
TEST(KeptRays, ARayIsCastAgainWhenTheCellThatItMetHasGone) {
  Volume v(Grid{70, 40, 24});
  put_solid(v, 35, 20, 12);
  put_solid(v, 35, 2, 12);
  put_solid(v, 60, 2, 20);
  v.changed.follow(v.grid);
  Kept kept;
  const rule::Heat heat = shone_by({{16 * 35 + 8, 16 * 39, 16 * 12 + 8}});
  const auto light = [&] { return kept.result[v.at(35, 2, 12)]; };
  ASSERT_NO_FATAL_FAILURE(expect_all_cast(kept, v, heat, 0, "shaded"));
  EXPECT_EQ(light(), 0);
  const std::int64_t cast = kept.provider.casts().cast;
  v.changed.new_version();
  v.solid.set(35, 20, 12, false);
  v.changed.mark(state::ChangedBricks::kMatter, 1, 20 / 8, 12 / 8);
  ASSERT_NO_FATAL_FAILURE(expect_all_cast(kept, v, heat, 0, "free"));
  EXPECT_GT(light(), 0);
  EXPECT_EQ(kept.provider.casts().cast, cast + 1);
}

// If every second cell is solid, its rays would take 52 bytes for each cell of the grid. So nothing is kept,
// and the bits are the same.
TEST(KeptRays, TakeNoMoreMemoryThanSaid) {
  Volume v(Grid{64, 48, 24});
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if ((x + y + z) % 2 == 0) put_solid(v, x, y, z);
  });
  Kept kept{KeptRays(), {}};
  const rule::Heat heat = shone_by({{5000, 4000, 3000}}, 16);
  const std::size_t bands = 24;
  for (int call = 0; call < 4; ++call) {
    ASSERT_NO_FATAL_FAILURE(expect_all_cast(kept, v, heat, 0, "call " + std::to_string(call)));
    EXPECT_LE(kept.provider.kept_bytes(), KeptRays::kMostKept * v.grid.cells() + (bands << 14));
    for (int y = 0; y < 48; ++y) v.solid.set(10 + call, y, 3, false);
  }
  EXPECT_EQ(kept.provider.kept_bytes(), 0u);
}

// A result that is not the one of the last call is written whole.
TEST(KeptRays, AnotherResultIsWrittenWhole) {
  Random random(2);
  const Volume v = hostile_world(random, {20, 20, 20});
  const rule::Heat heat = shone_by({{600, 600, 600}});
  KeptRays provider;
  state::Field<std::uint16_t> one(v.grid), other(v.grid);
  other.data()[5] = 77;
  provider.irradiance(v, heat, 0, one);
  provider.irradiance(v, heat, 0, other);
  EXPECT_EQ(one, other);
}

// A lamp that grows where it is has other shadows, also where nothing else has changed.
TEST(KeptRays, AnotherRadiusIsCastAnew) {
  Volume v(Grid{24, 24, 24});
  for_each({0, 0, 0, 24, 2, 24}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 0); });
  for_each({10, 8, 10, 14, 9, 14}, [&](int x, int y, int z) { put_solid(v, x, y, z, kOne, 0); });
  Kept kept;
  std::vector<state::Field<std::uint16_t>> lights;
  for (const std::int64_t radius : {10, 80, 10}) {
    const Shine lamp{rule::SourceKind::sphere,
                     {.at = {16 * 12, 16 * 18, 16 * 12}, .power = kRayPower, .radius = radius}};
    ASSERT_NO_FATAL_FAILURE(
        expect_all_cast(kept, v, shone_by({lamp}, 16, 7), 0, "radius " + std::to_string(radius)));
    lights.push_back(kept.result);
  }
  EXPECT_TRUE(lights[0] == lights[2]);
  EXPECT_FALSE(lights[0] == lights[1]) << "the radius does not matter";
}

}  // namespace
}  // namespace voxmelt::visibility
