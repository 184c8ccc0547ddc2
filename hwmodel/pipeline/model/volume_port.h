// These functions move tokens between the memory that holds a volume and the stream.
#pragma once

#include <tuple>
#include <type_traits>

#include "hwmodel/pipeline/model/cell.h"
#include "hwmodel/pipeline/model/shape.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

// Pairs a number that a word in memory holds with its wire. A volume may lack an optional field.
template <auto kOfCell, auto kOfVolume>
struct MemoryNumber {
  static void read(const state::Volume& volume, state::Slot slot, Cell& cell) {
    const auto& numbers = volume.*kOfVolume;
    cell.*kOfCell = numbers.empty() ? 0 : numbers[slot];
  }
  static void write(const Cell& cell, state::Volume& volume, state::Slot slot) {
    auto& numbers = volume.*kOfVolume;
    if (numbers.empty()) return;
    auto& number = numbers[slot];
    number = static_cast<std::remove_reference_t<decltype(number)>>(cell.*kOfCell);
  }
};
inline constexpr std::tuple<
    MemoryNumber<&Cell::amount, &state::Volume::amount>, MemoryNumber<&Cell::energy, &state::Volume::energy>,
    MemoryNumber<&Cell::heat, &state::Volume::heat>, MemoryNumber<&Cell::material, &state::Volume::material>>
    kMemoryNumbers;

inline void read_numbers(const state::Volume& volume, state::Slot slot, Cell& cell) {
  std::apply([&](const auto&... number) { (number.read(volume, slot, cell), ...); }, kMemoryNumbers);
}

inline State state_at(const state::Volume& volume, int x, int y, int z) {
  if (volume.inert.test(x, y, z)) return State::inert;
  if (volume.solid.test(x, y, z)) return State::solid;
  return volume.liquid.test(x, y, z) ? State::liquid : State::air;
}

// Reads a token. Lanes beyond the grid are border. `set` has the places that are set; null: none is.
inline void read_token(const state::Volume& volume, const Shape& shape, const Place& place, Cell* lanes,
                       const state::BitPlane* set = nullptr) {
  for (int lane = 0; lane < shape.lanes; ++lane) {
    lanes[lane] = {};
    const int x = place.x + lane;
    if (x >= shape.grid.x) continue;
    const state::Slot slot = volume.at(x, place.y, place.z);
    lanes[lane].state = state_at(volume, x, place.y, place.z);
    if (set != nullptr) lanes[lane].set = set->test(x, place.y, place.z);
    read_numbers(volume, slot, lanes[lane]);
  }
}

inline void write_cell(const Cell& cell, int x, int y, int z, state::Volume& volume) {
  const state::Slot slot = volume.at(x, y, z);
  volume.inert.set(x, y, z, cell.state == State::inert);
  volume.solid.set(x, y, z, cell.state == State::solid);
  volume.liquid.set(x, y, z, cell.state == State::liquid);
  std::apply([&](const auto&... number) { (number.write(cell, volume, slot), ...); }, kMemoryNumbers);
}

inline void write_token(const Cell* lanes, const Shape& shape, const Place& place, state::Volume& volume,
                        state::BitPlane* set = nullptr) {
  for (int lane = 0; lane < shape.lanes && place.x + lane < shape.grid.x; ++lane) {
    write_cell(lanes[lane], place.x + lane, place.y, place.z, volume);
    if (set != nullptr) set->set(place.x + lane, place.y, place.z, lanes[lane].set > 0);
  }
}

}  // namespace voxmelt::hwmodel
