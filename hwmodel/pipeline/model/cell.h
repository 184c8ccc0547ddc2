// What travels through the pipeline: one word per cell, P of them (neighbours along x) per token and cycle.
#pragma once

#include <cstdint>

#include "hwmodel/fabric/wires.h"

namespace voxmelt::hwmodel {

inline constexpr std::int64_t kOne = 4096;  // a full cell, UQ4.12
inline constexpr std::int64_t kAmountMax = 65535;
inline constexpr std::int64_t kHeatMax = 65535;
inline constexpr std::int64_t kFlatBed = 2048;  // amount of an inert cell whose surface is its upper face

// Two bits. `air` and `liquid` are told apart by the amount (docs/automaton.md, section 1).
enum class State : std::uint8_t { air, liquid, solid, inert };

// What memory has of a cell. The words that stages keep in their memories begin with it, too: what no stage
// computes with goes through all of them. A default one is the border: flat inert.
struct StoredCell {
  UInt<16> amount = kFlatBed;  // inert: bed offset
  UInt<16> energy, heat;
  State state = State::inert;

  StoredCell& stored() { return *this; }
  const StoredCell& stored() const { return *this; }
  bool blocked() const { return state == State::solid || state == State::inert; }
  bool matter() const { return state == State::solid || state == State::liquid; }
  bool air() const { return state == State::air; }
  bool liquid() const { return state == State::liquid; }

  friend bool operator==(const StoredCell&, const StoredCell&) = default;
};

// A cell, and the side-band signals that live only between the stages named beside them. Which fields a
// channel really has depends on the scene: Design::cell_bits.
struct Cell : StoredCell {
  UInt<2> exposed_axes;  // conduction -> exchange: axes on which a face neighbour is air
  UInt<8> pattern;       // pattern -> apply: directions that the cell gives to
  UInt<1> beside_wall;   // conduction, walls or viscous spread -> gravity: one of the four sides is blocked
  UInt<1> in_run;        // settle -> viscous spread -> gravity
  // settle -> viscous spread, of cells in a run. Head in 1/512 cell (the used width depends on the grid's
  // height), mobility in 1/2^24 before it is limited, its limit in 1/65536; head differences up to `dead`
  // do not move the cell.
  SInt<30> head;
  UInt<22> mobility;
  UInt<14> limit;
  UInt<25> dead;

  // For the end of a phase: a cell that is not blocked becomes liquid if it holds something, and otherwise
  // empty and cold.
  void settle_state() {
    if (blocked()) return;
    state = amount > 0 ? State::liquid : State::air;
    if (amount == 0) energy = heat = 0;
  }

  friend bool operator==(const Cell&, const Cell&) = default;
};

}  // namespace voxmelt::hwmodel
