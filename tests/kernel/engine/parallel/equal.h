// Two implementations side by side: after every phase the same state and the same books.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::worlds {

// The first difference of two states, with both values; empty where there is none.
inline std::string difference(const Volume& expected, const Volume& actual) {
  if (expected == actual) return {};
  std::string found;
  for_each(whole(expected.grid), [&](int x, int y, int z) {
    if (!found.empty()) return;
    const state::Slot i = expected.at(x, y, z);
    const auto check = [&](const char* field, int a, int b) {
      if (a != b && found.empty())
        found = std::string(field) + " at " + std::to_string(x) + ", " + std::to_string(y) + ", " +
                std::to_string(z) + ": expected " + std::to_string(a) + ", is " + std::to_string(b);
    };
    check("solid", expected.solid.test(x, y, z), actual.solid.test(x, y, z));
    check("inert", expected.inert.test(x, y, z), actual.inert.test(x, y, z));
    check("amount", expected.amount[i], actual.amount[i]);
    check("energy", expected.energy[i], actual.energy[i]);
    check("heat", expected.heat[i], actual.heat[i]);
    check("liquid", expected.liquid.test(x, y, z), actual.liquid.test(x, y, z));
  });
  return found.empty() ? "the padding, which must stay 0" : found;
}

// A cell that is not what it was, in a brick that is not told to have changed; empty where there is none.
inline std::string untold(const Volume& before, const state::ChangedBricks::Seen& seen, const Volume& after) {
  if (after.changed.all_since(seen)) return {};
  const Grid bricks = state::brick_grid(after.grid);
  std::string found;
  for_each(whole(after.grid), [&](int x, int y, int z) {
    const std::size_t brick = bricks.index(x / 8, y / 8, z / 8);
    const state::Slot i = after.at(x, y, z);
    if (after.changed.since(state::ChangedBricks::kMatter, seen, brick) || !found.empty()) return;
    for (const auto field : {&Volume::amount, &Volume::energy})
      if ((before.*field)[i] != (after.*field)[i]) found = "a field";
    if (before.heat[i] != after.heat[i] && !after.changed.since(state::ChangedBricks::kHeat, seen, brick))
      found = "heat";
    for (const auto mask : {&Volume::solid, &Volume::liquid, &Volume::inert})
      if ((before.*mask).test(x, y, z) != (after.*mask).test(x, y, z)) found = "a mask";
    if (!found.empty())
      found += " at " + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z);
  });
  return found;
}

inline const step::Implementation& implementation(const std::string& name) {
  return *run::implementations().find(name);
}

// Runs both for `count` steps; false at the first difference, or the first change that is not told.
inline bool same_steps(const Parameters& parameters, const Volume& start, const std::string& name,
                       const step::Tuning& tuning, int count) {
  run::Simulation expected(parameters, start, implementation("reference"));
  run::Simulation actual(parameters, start, implementation(name), tuning);
  Volume before = start;
  state::ChangedBricks::Seen seen = actual.volume().changed.now();
  for (int step = 0; step < count; ++step) {
    expected.begin_step();
    actual.begin_step();
    for (const step::Phase phase : expected.phases()) {
      expected.run_phase(phase);
      actual.run_phase(phase);
      const std::string found = difference(expected.volume(), actual.volume());
      if (found.empty() && expected.ledger() == actual.ledger()) continue;
      ADD_FAILURE() << name << ", threads " << tuning.threads << ", tile_shift " << tuning.tile_shift
                    << ", sleep " << tuning.sleep << ", step " << step << ", phase "
                    << step::kPhaseNames[static_cast<std::size_t>(phase)] << ": "
                    << (found.empty() ? "the books differ" : found);
      return false;
    }
    expected.end_step();
    actual.end_step();
    const std::string change = untold(before, seen, actual.volume());
    if (!change.empty()) {
      ADD_FAILURE() << name << ", tile_shift " << tuning.tile_shift << ", step " << step << ": " << change
                    << " has changed, and nobody told";
      return false;
    }
    if (step % 3 == 1) continue;  // changes of several steps add up
    before = actual.volume();
    seen = actual.volume().changed.now();
  }
  return true;
}

inline std::vector<std::string> fast_implementations() {
  std::vector<std::string> names;
  for (const step::Implementation& one : run::implementations().all())
    if (one.supported && one.name != "reference") names.push_back(one.name);
  return names;
}

}  // namespace voxmelt::worlds
