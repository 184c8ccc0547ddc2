// Solids of several materials, with colours, for random pictures.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "tests/kernel/worlds.h"

namespace voxmelt::test {

// Gives the look a colour for each of 16 materials.
inline void sixteen_materials(scene::Look& look, worlds::Random& random) {
  look.materials.clear();
  while (look.materials.size() < 16)
    look.materials.push_back({0.25 * random.below(4), random.below(4097) / 4096.0, 0.5});
}

// Gives the look the colours of up to 16 materials. Some are equal, and some are as far from the first as
// others.
inline void any_materials(scene::Look& look, worlds::Random& random) {
  look.materials.clear();
  const int count = random.any({0, 1, 2, 2, 3, 4, 7, 16});
  const auto channel = [&] {
    return random.any({0.0, 1.0, 0.25, 0.5, 0x1p-13, random.below(4097) / 4096.0});
  };
  while (static_cast<int>(look.materials.size()) < count)
    look.materials.push_back({channel(), channel(), channel()});
}

// Gives all cells materials that the look has colours of, in layers with single cells amid them.
inline void of_any_materials(state::Volume& volume, const scene::Look& look, worlds::Random& random) {
  const int count = static_cast<int>(look.materials.size());
  if (count < 2) return;
  volume.material = state::Field<std::uint8_t>(volume.grid);
  const int thick = random.between(1, 9);
  worlds::for_each(worlds::whole(volume.grid), [&](int x, int y, int z) {
    const int layer = (x + y + z) / thick % count;
    volume.material[volume.at(x, y, z)] =
        static_cast<std::uint8_t>(random.one_in(9) ? random.below(count) : layer);
  });
}

}  // namespace voxmelt::test
