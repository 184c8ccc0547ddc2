// What each cell contributes to the picture, before filtering (paper, section 5).
//
// Intensities are the paper's 0..255 with eight fraction bits (u16, kFull = 255 * 256): linear in the
// amount of a cell, full at kOne and above. Arrays are [z][y][x], x fastest.
//
// The ground is the inert cells that reach up from y = 0, no higher than the terrain where that is known. It
// is filled below and beside matter, because otherwise the surface of a thin film would sink into the floor
// and the rim of a puddle would curl. Next to dry ground the filling ends a little below the ground, so that
// the surface closes where the ground hides it.
//
// Every other inert cell is part of an obstacle: a thing of its own, drawn like a solid.
//
// Puddles are shifted up or down by a fraction of a cell to take their terraces out (see levels.h).
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/scene/look.h"
#include "kernel/state/volume.h"

namespace voxmelt::render {

inline constexpr std::int32_t kFull = 255 * 256;

struct CellFields {
  state::Grid grid;
  std::vector<std::uint16_t> intensity;  // matter, obstacles and the ground that carries them
  std::vector<std::uint16_t> solid;      // the solid's part of the intensity
  std::vector<std::uint16_t> liquid;     // the liquid's part
  std::vector<std::uint16_t> heat;       // liquid * temperature, so that thin cells weigh little
  std::vector<std::uint16_t> obstacle;   // the obstacles' part; empty where there is none
  std::vector<float> ground;             // [z][x]: height of the ground in cells, 0 where there is none
  std::vector<float> wetness;            // [z][x]: 0 dry ground .. 1 covered by at least a thin film

  friend bool operator==(const CellFields&, const CellFields&) = default;
};

// Heights for every column of the grid: only then a terrain says what is ground. All zero: nothing is.
bool fits(const scene::Terrain& terrain, const state::Grid& grid);

// `smooth`: how much the terraces of puddles are smoothed, 0: not at all.
CellFields cell_fields(const state::Volume& volume, int smooth = 0, const scene::Terrain& terrain = {});

}  // namespace voxmelt::render
