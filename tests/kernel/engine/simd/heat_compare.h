// These functions compare two volumes, two ledgers, or the changes with those that were reported.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "kernel/automaton/state/difference.h"
#include "tests/kernel/engine/scalar/hostile.h"
#include "tests/kernel/engine/simd/heat_driver.h"

namespace voxmelt::simd {

using namespace worlds;

inline step::Irradiance hostile_irradiance(Random& random, const Volume& v, bool faint) {
  step::Irradiance field(v.grid);
  for_each(whole(v.grid), [&](int x, int y, int z) {
    if (v.solid.test(x, y, z))
      field[v.at(x, y, z)] = static_cast<std::uint16_t>(
          faint ? random.any({0, 0, 0, 0, 1})
                : random.any({0, 1, 15, 16, 17, 4095, 65535, random.below(65536)}));
  });
  return field;
}

inline std::string difference(const Volume& a, const Volume& b) {
  const auto found = state::first_difference(a, b);
  return found ? text_of(*found) : "in the padding";
}

inline std::string terms(const state::Ledger& ledger) {
  std::string text;
  const auto append = [&text](const auto& one) {
    for (const auto& term : one.table())
      text += std::string(term.name) + " " + state::to_string(one.*term.value) + " ";
  };
  append(ledger.mass);
  append(ledger.energy);
  append(ledger.heat);
  return text;
}

inline std::string terms(const Books& books) {
  state::Ledger ledger;
  ledger.book(books);
  return terms(ledger);
}

// Returns the tiles in which the volumes differ.
inline TileSet tiles_between(const View& view, const Volume& a, const Volume& b) {
  TileSet set(view, false);
  for_each(whole(a.grid), [&](int x, int y, int z) {
    if (!state::same_cell(a, b, x, y, z)) set.slice(z)[y >> view.tile_shift] |= TileRow{1} << (x / 64);
  });
  return set;
}

inline void expect_reported(const View& view, const Volume& before, const Volume& after, TileSet changed) {
  const std::int64_t told = changed.count();
  changed.add(tiles_between(view, before, after));
  ASSERT_EQ(changed.count(), told) << "a change was not reported";
}

}  // namespace voxmelt::simd
