// The field that is drawn is written plainly here: it computes whole grids anew, one cell after the other.
// The pieces that render/density keeps up to date must be the same, bit for bit.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "render/density/density_field.h"
#include "render/density/levels.h"

namespace voxmelt::test {

using Cells = std::vector<std::uint16_t>;

struct PlainCells {
  Cells intensity, solid, liquid, heat, obstacle;
  std::vector<std::int32_t> ground, wetness;
};
std::vector<std::int32_t> plain_level_shifts(const render::PuddleLevels& levels, int passes);
PlainCells plain_cells(const state::Volume& volume, int smooth, const scene::Terrain& terrain);

Cells plain_low_pass(const state::Grid& grid, int passes, const Cells& from);

// Checks everything that can be drawn of the field against the plain one.
void expect_plain(const render::DensityField& field, const state::Volume& volume, const scene::Look& look,
                  const scene::Terrain& terrain = {});

}  // namespace voxmelt::test
