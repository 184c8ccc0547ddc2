// The state of a volume has three bit-packed masks and three 16-bit fields, all [z][y][x], x fastest.
//
//   solid   meltable solid; amount is its mass (a full cell holds kOne; a surface cell its covered part)
//   inert   never melts and never moves; its amount is the bed offset (kBedHalf: flat), no mass; with heat
//           above 0 it is an isothermal wall, which keeps its temperature
//   liquid  exactly the cells that are neither and hold amount > 0
// A scene with several materials has a field of 8 bits with the number of each solid's material.
//
// A cell with neither solid nor liquid has energy 0 and, unless it is such a wall, heat 0. An empty cell has
// amount 0 too. A cell of amount 0 has no heat, so the bed offset of a wall is at least 1. A field that a
// scene does not use (energy, heat) takes no memory, nor do empty pages.
//
// The record of its changes is no part of the state: volumes that differ in it alone are equal.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/automaton/state/field.h"
#include "kernel/automaton/state/grid.h"

namespace voxmelt::state {

struct Volume {
  Volume() = default;
  explicit Volume(Grid size);  // 0 everywhere; without the optional fields

  Slot at(int x, int y, int z) const { return amount.layout().at(x, y, z); }

  Grid grid;
  // Each member has a row in fields.h.
  BitPlane solid, liquid, inert;
  Field<std::uint16_t> amount, energy, heat;
  Field<std::uint8_t> material;  // of solids, 0 elsewhere; empty unless the scene has several

  ChangedBricks changed;

  friend bool operator==(const Volume& a, const Volume& b);
};

}  // namespace voxmelt::state
