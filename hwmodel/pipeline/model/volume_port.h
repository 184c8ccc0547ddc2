// Between the memory that holds a volume and the stream: a token read, a token written.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/model/cell.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

inline State state_at(const state::Volume& volume, int x, int y, int z) {
  if (volume.inert.test(x, y, z)) return State::inert;
  if (volume.solid.test(x, y, z)) return State::solid;
  return volume.liquid.test(x, y, z) ? State::liquid : State::air;
}

// Lanes beyond the grid are border.
inline void read_token(const state::Volume& volume, const Shape& shape, const Place& place, Cell* lanes) {
  for (int lane = 0; lane < shape.lanes; ++lane) {
    lanes[lane] = {};
    const int x = place.x + lane;
    if (x >= shape.grid.x) continue;
    const state::Slot slot = volume.at(x, place.y, place.z);
    lanes[lane].state = state_at(volume, x, place.y, place.z);
    lanes[lane].amount = volume.amount[slot];
    lanes[lane].energy = volume.energy[slot];
    lanes[lane].heat = volume.heat[slot];
  }
}

inline void write_cell(const Cell& cell, int x, int y, int z, state::Volume& volume) {
  const state::Slot slot = volume.at(x, y, z);
  volume.inert.set(x, y, z, cell.state == State::inert);
  volume.solid.set(x, y, z, cell.state == State::solid);
  volume.liquid.set(x, y, z, cell.state == State::liquid);
  volume.amount[slot] = static_cast<std::uint16_t>(cell.amount);
  volume.energy[slot] = static_cast<std::uint16_t>(cell.energy);
  volume.heat[slot] = static_cast<std::uint16_t>(cell.heat);
}

inline void write_token(const Cell* lanes, const Shape& shape, const Place& place, state::Volume& volume) {
  for (int lane = 0; lane < shape.lanes && place.x + lane < shape.grid.x; ++lane)
    write_cell(lanes[lane], place.x + lane, place.y, place.z, volume);
}

}  // namespace voxmelt::hwmodel
