// Makes small volumes for the renderer's tests.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/fixed_point.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"

namespace voxmelt::test {

inline constexpr int kFloor = 2;  // cells of floor

inline state::Volume floor_volume(state::Grid grid) {
  state::Volume volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < kFloor; ++y)
      for (int x = 0; x < grid.x; ++x) {
        volume.inert.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = rule::kBedHalf;
      }
  return volume;
}

inline scene::Terrain floor_terrain(state::Grid grid) {
  scene::Terrain terrain;
  terrain.x = grid.x;
  terrain.z = grid.z;
  terrain.height.assign(static_cast<std::size_t>(grid.x) * static_cast<std::size_t>(grid.z), kFloor);
  return terrain;
}

// Pours a column of liquid of the given height on the floor: full cells and a part-filled one.
inline void pour(state::Volume& volume, int x, int z, double height, double temperature = 0.5) {
  int left = static_cast<int>(std::lround(height * rule::kOne));
  for (int y = kFloor; left > 0 && y < volume.grid.y; ++y, left -= rule::kOne) {
    const state::Slot i = volume.at(x, y, z);
    volume.liquid.set(x, y, z, true);
    volume.amount[i] = static_cast<std::uint16_t>(std::min(left, rule::kOne));
    volume.heat[i] = static_cast<std::uint16_t>(temperature * rule::kTemperatureMax);
  }
}

inline void ball(state::Volume& volume, double cx, double cy, double cz, double radius) {
  const state::Grid& grid = volume.grid;
  for (int z = 0; z < grid.z; ++z)
    for (int y = kFloor; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        const double distance = std::hypot(x + 0.5 - cx, y + 0.5 - cy, z + 0.5 - cz);
        const double covered = std::clamp(radius - distance + 0.5, 0.0, 1.0);
        if (covered <= 0 || volume.liquid.test(x, y, z)) continue;
        volume.solid.set(x, y, z, true);
        volume.amount[volume.at(x, y, z)] = static_cast<std::uint16_t>(std::max(1.0, covered * rule::kOne));
      }
}

// Makes a ball above a flat puddle, so that every part of the renderer has something to do.
inline state::Volume ball_and_puddle(state::Grid grid) {
  state::Volume volume = floor_volume(grid);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      const double r = std::hypot(x + 0.5 - grid.x * 0.5, z + 0.5 - grid.z * 0.5) / (grid.x * 0.4);
      if (r < 1) pour(volume, x, z, 3 * std::sqrt(1 - r * r), 0.9 - 0.4 * r);
    }
  ball(volume, grid.x * 0.5, grid.y * 0.5, grid.z * 0.5, grid.x * 0.2);
  return volume;
}

inline scene::Camera small_camera(state::Grid grid, int width = 96, int height = 72) {
  scene::Camera camera;
  camera.target = {grid.x * 0.5, grid.y * 0.3, grid.z * 0.5};
  camera.width = width;
  camera.height = height;
  return camera;
}

}  // namespace voxmelt::test
