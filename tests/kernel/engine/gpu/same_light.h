// A device follows the rays of heat sources itself. The irradiance of each cell must be that of the
// definition.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kernel/engine/visibility/kept_rays.h"
#include "tests/kernel/engine/gpu/same_steps.h"
#include "tests/kernel/engine/visibility/ray_worlds.h"

namespace voxmelt::worlds {

using visibility::Shine;

// Returns the first cell that has another irradiance, or nothing.
inline std::string difference(const step::Irradiance& expected, const step::Irradiance& actual,
                              const Volume& v) {
  std::string found;
  for_each(whole(v.grid), [&](int x, int y, int z) {
    const state::Slot at = v.at(x, y, z);
    if (!found.empty() || expected[at] == actual[at]) return;
    found = "irradiance at " + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z) +
            ": " + std::to_string(expected[at]) + " is " + std::to_string(actual[at]);
  });
  return !found.empty() || expected == actual ? found : "the padding, which must stay 0";
}

// Sources of any kind, or of this one alone. Many of them cut the nearest cells.
inline rule::Heat any_light(Random& random, const Grid& g, const rule::SourceKindRow* kind = nullptr) {
  std::vector<Shine> shines;
  for (int n = random.between(1, 3); n > 0; --n) {
    Shine shine = kind != nullptr ? visibility::awkward_shine(random, g, kind->kind)
                                  : visibility::awkward_shine(random, g);
    shine.key.power = random.any<std::uint64_t>(
        {0, 1000, 1 << 20, 1 << 24, std::uint64_t{1} << 36, (std::uint64_t{1} << 50) - 1});
    shines.push_back(shine);
  }
  return visibility::shone_by(shines, random.any({1, 4, 16}), random.bits());
}

// Solids of any amount, among inert cells and liquid. Where two of its boxes meet, a cell is solid.
inline Volume any_body(Random& random, const Grid& g) {
  Volume v = visibility::hostile_world(random, g);
  for_each(whole(g), [&](int x, int y, int z) {
    if (!v.solid.test(x, y, z)) return;
    v.inert.set(x, y, z, false);
    if (random.one_in(3)) v.amount[v.at(x, y, z)] = static_cast<std::uint16_t>(hostile_amount(random));
  });
  return v;
}

// Counts cells and rays of all worlds, to see that there were some.
struct Lights {
  std::int64_t lit = 0, capped = 0, rays = 0, dark = 0;
};

// Compares the light of a device with the definition, in a body that loses cells from call to call.
inline bool same_light_on_device(int seed, const rule::SourceKindRow* kind, const MakeDevice& make,
                                 Lights& all) {
  Random random(static_cast<std::uint64_t>(seed) * 3571 +
                (kind != nullptr ? rule::index_of(kind->kind) + 1 : 0));
  Volume v = any_body(random, visibility::hostile_grid(random));
  Parameters p;
  p.heat = any_light(random, v.grid, kind);
  gpu::Stepper device(make(p, v.grid), p, v.grid);
  EXPECT_TRUE(device.follows_rays(p.heat));
  step::RayCounts counts;
  step::Irradiance actual(v.grid);
  for (std::uint32_t call = 0; call < 3; ++call) {
    step::Irradiance expected(v.grid);
    counts.capped += visibility::VoxelWalkProvider().irradiance(v, p.heat, call, expected);
    visibility::KeptRays counting;
    step::Irradiance same(v.grid);
    counting.irradiance(v, p.heat, call, same);
    counts.rays += counting.casts().asked;
    device.upload(v, state::Ledger::open(v));
    device.find_irradiance(call);
    device.download_irradiance(actual);
    const step::RayCounts found = device.count_rays();
    std::string wrong = difference(expected, actual, v);
    if (wrong.empty() && found.capped != counts.capped) wrong = "cuts";
    if (wrong.empty() && found.rays != counts.rays) wrong = "rays";
    if (!wrong.empty()) {
      ADD_FAILURE() << "seed " << seed << ", call " << call << ": " << wrong;
      return false;
    }
    for_each(whole(v.grid), [&](int x, int y, int z) {
      const bool solid = v.solid.test(x, y, z), light = expected[v.at(x, y, z)] > 0;
      all.lit += light;
      all.dark += solid && !light;
      if (solid && random.one_in(3)) {
        v.solid.set(x, y, z, false);
        v.amount[v.at(x, y, z)] = 0;
      }
    });
  }
  all.capped += counts.capped;
  all.rays += counts.rays;
  return true;
}

// A world of the hostile ones, with sources of all kinds, which move and dim.
inline Parameters lit_by_any(Random& random, Parameters parameters, const Grid& g) {
  rule::Heat light = any_light(random, g);
  for (rule::HeatSource& source : light.sources) {
    rule::SourceKey later = visibility::awkward_shine(random, g, source.kind).key;
    later.step = 4;
    source.keys.push_back(later);
  }
  parameters.heat.enabled = parameters.heat.radiation = true;
  parameters.heat.rays_per_face = light.rays_per_face;
  parameters.heat.sources = std::move(light.sources);
  return parameters;
}

// Returns what a run on a device and its twin have different, or nothing. Their irradiance is looked at.
inline std::string difference_of_runs(const run::Simulation& expected, const run::Simulation& actual) {
  if (std::string found = difference(*expected.irradiance(), *actual.irradiance(), expected.volume());
      !found.empty())
    return found;
  if (std::string found = difference(expected.volume(), actual.volume()); !found.empty()) return found;
  if (!(expected.ledger() == actual.ledger())) return "the books";
  if (expected.irradiance_capped() != actual.irradiance_capped()) return "cuts";
  return expected.casts().asked == actual.casts().asked ? "" : "rays";
}

}  // namespace voxmelt::worlds
