// Two implementations run side by side. After every phase they must have the same state and the same books.
#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "kernel/automaton/state/difference.h"
#include "kernel/automaton/state/fields.h"
#include "tests/kernel/engine/scalar/hostile.h"

namespace voxmelt::worlds {

// Returns the first difference of two states, with both values, or nothing if they are equal.
inline std::string difference(const Volume& expected, const Volume& actual) {
  if (expected == actual) return {};
  const auto found = state::first_difference(expected, actual);
  return found ? text_of(*found) : "the padding, which must stay 0";
}

// Returns the field of a changed cell in a brick whose change was not told, or nothing if all was told.
inline std::string untold(const Volume& before, const state::ChangedBricks::Seen& seen, const Volume& after) {
  if (after.changed.all_since(seen)) return {};
  const Grid bricks = state::brick_grid(after.grid);
  std::string found;
  for_each(whole(after.grid), [&](int x, int y, int z) {
    const std::size_t brick = bricks.index(x / 8, y / 8, z / 8);
    const auto told = [&](state::ChangedBricks::Part part) { return after.changed.since(part, seen, brick); };
    using Changed = state::ChangedBricks;
    const bool matter = told(Changed::kMatter), heat = told(Changed::kHeat), walls = told(Changed::kWalls);
    if ((matter && walls) || !found.empty()) return;
    state::for_each_field([&](const auto& row) {
      const auto &was = before.*row.column, &is = after.*row.column;
      const bool is_wall = row.name == "solid" || row.name == "inert";
      if (was.empty() || (row.name == "heat" ? heat : matter && (walls || !is_wall))) return;
      if (value_at(was, x, y, z) != value_at(is, x, y, z)) found = row.name;
    });
    if (!found.empty())
      found += " at " + std::to_string(x) + ", " + std::to_string(y) + ", " + std::to_string(z);
  });
  return found;
}

inline const step::Implementation& implementation(const std::string& name) {
  return *run::implementations().find(name);
}

// Runs both for `count` steps. Returns false at the first difference, or at the first change that is not
// told.
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
