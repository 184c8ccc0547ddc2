// A volume of the host and the state of a device have the same cells in other places.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/stepper.h"
#include "kernel/engine/gpu/shape.h"

namespace voxmelt::gpu {

// Is a state as program/cells.cl has it. The border is inert and flat.
struct Packed {
  std::vector<std::uint8_t> flags;
  std::vector<std::uint16_t> amount, energy, heat;
};

Packed packed(const state::Volume& volume, const Shape& shape);
std::vector<std::uint16_t> packed(const step::Irradiance& irradiance, const Shape& shape);

// Words of 64 cells along x, each with the place of its first cell.
inline constexpr int kWordCells = 64;
struct PackedWords {
  std::vector<std::int32_t> places;
  std::vector<std::uint16_t> numbers;  // kWordCells for each
};
PackedWords packed_words(const step::Irradiance& irradiance, const state::ChangedRows& rows,
                         const Shape& shape);

// Writes all cells of an irradiance of the same grid.
void unpack(const std::vector<std::uint16_t>& numbers, const Shape& shape, step::Irradiance& irradiance);

// They write into a volume of the same grid. Energy and heat may be missing; then they stay.
void unpack(const Packed& packed, const Shape& shape, state::Volume& volume);
void unpack_masks(const std::vector<std::uint8_t>& flags, const Shape& shape, state::Volume& volume);

}  // namespace voxmelt::gpu
