// What each cell contributes to the picture, before filtering (paper, section 5).
//
// Intensities are the paper's 0..255 with eight fraction bits (u16, kFull = 255 * 256): linear in the
// amount of a cell, full at kOne and above. Arrays are [z][y][x], x fastest.
//
// The ground (the inert cells that reach up from y = 0) is filled below and beside matter, because otherwise
// the surface of a thin film would sink into the floor and the rim of a puddle would curl. Next to dry ground
// the filling ends a little below the ground, so that the surface closes where the ground hides it.
//
// Puddles are shifted up or down by a fraction of a cell to take their terraces out (see levels.h).
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/state/volume.h"

namespace voxmelt::render {

inline constexpr std::int32_t kFull = 255 * 256;

struct CellFields {
  state::Grid grid;
  std::vector<std::uint16_t> intensity;  // matter and the ground that carries it
  std::vector<std::uint16_t> solid;      // the solid's part of the intensity (obstacles count as solid)
  std::vector<std::uint16_t> liquid;     // the liquid's part
  std::vector<std::uint16_t> heat;       // liquid * temperature, so that thin cells weigh little
  std::vector<float> ground;             // [z][x]: height of the ground in cells, 0 where there is none
  std::vector<float> wetness;            // [z][x]: 0 dry ground .. 1 covered by at least a thin film

  friend bool operator==(const CellFields&, const CellFields&) = default;
};

// `smooth`: how much the terraces of puddles are smoothed, 0: not at all.
CellFields cell_fields(const state::Volume& volume, int smooth = 0);

}  // namespace voxmelt::render
