// The neighbours of a cell are read from a volume. Tests compare the side bands `beside_wall` and `touches`
// with them, or fill the bands from them.
#pragma once

#include "hwmodel/pipeline/model/cell.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

inline bool is_blocked(const state::Volume& v, int x, int y, int z) {
  return !v.grid.contains(x, y, z) || v.solid.test(x, y, z) || v.inert.test(x, y, z);
}

inline bool stands_beside_wall(const state::Volume& v, int x, int y, int z) {
  return is_blocked(v, x - 1, y, z) || is_blocked(v, x + 1, y, z) || is_blocked(v, x, y, z - 1) ||
         is_blocked(v, x, y, z + 1);
}

inline void mark_walls(const state::Volume& v, const Shape& shape, const Place& place, Cell* lanes) {
  for (int lane = 0; lane < shape.lanes && place.x + lane < shape.grid.x; ++lane)
    lanes[lane].beside_wall = stands_beside_wall(v, place.x + lane, place.y, place.z);
}

inline bool touches_something(const state::Volume& v, int x, int y, int z) {
  return stands_beside_wall(v, x, y, z) || is_blocked(v, x, y - 1, z) || is_blocked(v, x, y + 1, z);
}

inline void mark_touches(const state::Volume& v, const Shape& shape, const Place& place, Cell* lanes) {
  for (int lane = 0; lane < shape.lanes && place.x + lane < shape.grid.x; ++lane)
    lanes[lane].touches = touches_something(v, place.x + lane, place.y, place.z);
}

}  // namespace voxmelt::hwmodel
