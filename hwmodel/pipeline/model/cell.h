// One word per cell travels through the pipeline, and P of them (neighbours along x) per token and cycle.
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "hwmodel/fabric/wires.h"

namespace voxmelt::hwmodel {

inline constexpr std::int64_t kOne = 4096;  // a full cell, UQ4.12
inline constexpr std::int64_t kAmountMax = 65535;
inline constexpr std::int64_t kHeatMax = 65535;
inline constexpr std::int64_t kFlatBed = 2048;  // amount of an inert cell whose surface is its upper face

// A state takes two bits. `air` and `liquid` are told apart by the amount (docs/automaton.md, section 1).
enum class State : std::uint8_t { air, liquid, solid, inert };

// Holds what memory has of a cell. The words that stages keep in their memories begin with it, too, so that
// data that no stage computes with goes through all of them. The default is the border, which is flat and
// inert.
struct StoredCell {
  UInt<16> amount = kFlatBed;  // inert: bed offset
  UInt<16> energy, heat;
  UInt<4> material;  // of a solid, in scenes with several; elsewhere 0
  State state = State::inert;

  StoredCell& stored() { return *this; }
  const StoredCell& stored() const { return *this; }
  bool blocked() const { return state == State::solid || state == State::inert; }
  bool matter() const { return state == State::solid || state == State::liquid; }
  bool air() const { return state == State::air; }
  bool liquid() const { return state == State::liquid; }

  friend bool operator==(const StoredCell&, const StoredCell&) = default;
};

// Adds the side-band signals to a cell. They live only between the stages named beside them.
// Design::cell_bits tells which fields a channel really has, as this depends on the scene.
struct Cell : StoredCell {
  UInt<2> exposed_axes;  // conduction -> exchange: axes on which a face neighbour is air
  UInt<8> pattern;       // pattern -> apply: directions that the cell gives to
  UInt<1> beside_wall;   // conduction, walls or viscous spread -> gravity: one of the four sides is blocked
  UInt<1> touches;       // conduction -> melt: one of the six face neighbours is blocked
  UInt<1> set;           // melt -> gravity, pattern, settle and viscous spread: the place gives nothing
  UInt<1> in_run;        // settle -> viscous spread -> gravity
  UInt<1> shut;          // settle -> viscous spread: the run is full, and has a ceiling
  std::uint8_t unused = 0;
  // The following go from settle to viscous spread, for cells in a run. The head is in 1/512 cell, and its
  // used width depends on the grid's height. The mobility is in 1/2^24 before it is limited, and its limit in
  // 1/65536. Head differences up to `dead` do not move the cell.
  SInt<30> head;
  UInt<22> mobility;
  UInt<25> dead;
  UInt<14> limit;
  std::uint16_t unused_too = 0;

  // Ends a phase. A cell that is not blocked becomes liquid if it holds something, and otherwise empty and
  // cold.
  void settle_state() {
    if (blocked()) return;
    state = amount > 0 ? State::liquid : State::air;
    if (amount == 0) energy = heat = 0;
  }

  // No byte of a cell is without a meaning, so cells compare as bytes. The simulation compares every token.
  friend bool operator==(const Cell& a, const Cell& b) {
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): the assertion below allows it
    return std::memcmp(&a, &b, sizeof(Cell)) == 0;
  }
};
static_assert(sizeof(Cell) == 32 && std::has_unique_object_representations_v<Cell>);

}  // namespace voxmelt::hwmodel
