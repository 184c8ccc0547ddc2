// The level of puddles without their terraces.
//
// Liquid at rest in whole cells stands in terraces: its level, seen over many columns, rises and falls by a
// part of a cell about the smooth surface it stands for. A filter in space must be many cells wide to remove
// them and would take drops and threads with it. So the level itself is smoothed, along the surface only.
#pragma once

#include <cstdint>
#include <vector>

namespace voxmelt::render {

inline constexpr std::int32_t kNoLevel = INT32_MIN;  // no puddle in this column

// Columns, [z][x]; heights in kOne.
struct Levels {
  int x = 0, z = 0;
  std::vector<std::int32_t> level;  // height of the surface or kNoLevel
  std::vector<std::int32_t> depth;  // of the liquid
};

// How far each column's level must move: at most a quarter of a cell and a half of the depth. Even slopes
// stay where they are up to the rim; steps of two cells and more are no terraces and stay too.
std::vector<std::int32_t> level_shifts(const Levels& levels, int passes);

}  // namespace voxmelt::render
