// The state of the baseline is a real number or a byte per cell and field.
//
// Cells are [z][y][x], x fastest, y up, with a border of one inert cell on all six sides, so that no loop
// needs a case for the edge.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::baseline {

template <class Real>
struct Cell {
  Real amount = 0, energy = 0, temperature = 0;
  bool solid = false, liquid = false, inert = false;
};

template <class Real>
struct Fields {
  explicit Fields(const state::Volume& volume);
  ~Fields();

  // These are always inlined, so that no copy compiled for one instruction set can be linked in place of
  // another's.
  [[gnu::always_inline]] std::size_t at(int x, int y, int z) const {
    return (z + 1) * slice + (y + 1) * row + (x + 1);
  }
  [[gnu::always_inline]] bool blocked(std::size_t i) const { return solid[i] || inert[i]; }
  [[gnu::always_inline]] bool air(std::size_t i) const { return !solid[i] && !inert[i] && !liquid[i]; }

  Cell<Real> cell(int x, int y, int z) const;
  void set_cell(int x, int y, int z, const Cell<Real>& cell);
  double total(const std::vector<Real>& field) const;
  std::int64_t liquid_cells() const;

  state::Grid grid;
  std::size_t row, slice;  // from a cell to its neighbour in y, in z
  std::vector<Real> amount, energy, temperature;
  std::vector<std::uint8_t> solid, liquid, inert;

  std::vector<Real> next_temperature;
  std::vector<std::uint8_t> pattern;                      // directions that a cell gives to, a bit each
  std::vector<Real> amount_gain, energy_gain, heat_gain;  // the gains by spreading
  std::vector<std::uint8_t> intensity, filtered;          // the picture, before and after the low-pass filter
  std::vector<std::uint8_t> row_marks;                    // native variant: rows along x that hold anything
};

// Converts a kernel's irradiance (1/16 temperature unit per step) for the baseline: a value per cell
// [z][y][x] without border, in temperature per step.
template <class Real>
std::vector<Real> irradiance_of(const state::Grid& grid, const state::Field<std::uint16_t>& irradiance);

}  // namespace voxmelt::baseline
