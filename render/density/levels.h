// Puddles get a level without terraces.
//
// Liquid at rest in whole cells stands in terraces. Its level, seen over many columns, rises and falls by a
// part of a cell about the smooth surface it stands for. A filter in space must be many cells wide to remove
// them and would take drops and threads with it. So the level itself is smoothed, along the surface only.
#pragma once

#include <cstdint>
#include <vector>

#include "render/density/loops.h"

namespace voxmelt::render {

inline constexpr std::int32_t kNoLevel = INT32_MIN;  // no puddle in this column

// Holds the puddles by column, [z][x]. Heights are in kOne.
struct PuddleLevels {
  int x = 0, z = 0;
  std::vector<std::int32_t> level;  // height of the surface or kNoLevel
  std::vector<std::int32_t> depth;  // depth of the liquid
};

// Bounds some columns, from low to high.
struct ColumnBox {
  int low_x, low_z, high_x, high_z;

  static ColumnBox none() { return {INT32_MAX, INT32_MAX, INT32_MIN, INT32_MIN}; }
  bool empty() const { return low_x >= high_x; }
  void add(int x, int z);
  ColumnBox widened(int columns, int x, int z) const;  // within x * z columns
};

// Finds how far the level of each column of the box must move. This is at most a quarter of a cell and a half
// of the depth. Even slopes stay in place up to the rim. Steps of two cells and more are no terraces and
// stay, too. Other columns of `shifts` stay unchanged.
void find_shifts(const PuddleLevels& levels, int passes, const ColumnBox& box,
                 std::vector<std::int32_t>& shifts, const Loops& with = loops());

// Returns the shifts of all columns.
std::vector<std::int32_t> level_shifts(const PuddleLevels& levels, int passes);

}  // namespace voxmelt::render
