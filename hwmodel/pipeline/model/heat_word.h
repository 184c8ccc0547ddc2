// Conduction and convection keep this word of a cell. It holds what came, and the heat so far. A pass
// is synchronous, so every flux is computed from the temperatures at its begin. The heat takes the fluxes one
// by one and stays within 16 bits after each. The reason is that what any subset of the neighbours takes or
// gives is within the bound of docs/proofs.md, "Heat: 0 <= h <= 65535".
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// Holds a cell whose heat has the fluxes computed so far.
struct HeatWord : StoredCell {
  UInt<16> temperature;  // at the begin of the pass
  UInt<3> exposed;       // faces: a bit per axis on which a face neighbour is air; later: number of axes
  UInt<1> beside_wall, touches;

  bool wall() const { return state == State::inert && heat > 0; }  // it keeps its temperature
  bool conducts() const { return matter() || wall(); }
};

inline void take_cell(const Cell& cell, UInt<16> temperature, HeatWord& word) {
  word.stored() = cell.stored();
  word.temperature = temperature;
  word.exposed = std::int64_t{cell.exposed_axes};
  word.beside_wall = cell.beside_wall;
  word.touches = cell.touches;
}

inline Cell give_cell(const HeatWord& word, std::int64_t exposed_axes) {
  Cell cell;
  cell.stored() = word.stored();
  cell.exposed_axes = exposed_axes;
  cell.beside_wall = word.beside_wall;
  cell.touches = word.touches;
  return cell;
}

// Returns the bits of a word that a design needs. It has `exposed` bits if air exchange counts axes.
inline int heat_word_bits(const Design& design, int exposed) {
  return design.cell_bits() + 16 + (design.parameters.heat.air ? exposed : 0) +
         (design.walls_in_conduction() ? 1 : 0) + (design.freezes() ? 1 : 0);
}
// Returns the side bands of a cell that leaves conduction or convection.
inline Wires heated_bands(const Design& design) {
  return Wires()
      .add(Wire::exposed_axes, design.parameters.heat.air)
      .add(Wire::beside_wall, design.walls_in_conduction())
      .add(Wire::touches, design.freezes());
}

}  // namespace voxmelt::hwmodel
