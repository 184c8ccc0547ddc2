// Exact books of mass, energy and heat (docs/automaton.md, "Ledgers").
//
// Every term is summed where a rule applies it; none is found by subtraction. A ledger balances when
// start + all terms = what the state holds, to the unit.
#pragma once

#include <string>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

__extension__ using Sum = __int128;

std::string to_string(Sum value);

// What a state holds, in the units of each ledger.
struct Holdings {
  Sum solid = 0, liquid = 0;  // mass: sum of amount
  Sum energy = 0;             // sum of energy
  Sum heat = 0;               // sum of amount x heat content over solid and liquid
};

Holdings holdings(const Volume& volume);

struct MassLedger {
  Sum start = 0, added = 0, removed = 0;
  Sum expected() const { return start + added - removed; }
  friend bool operator==(const MassLedger&, const MassLedger&) = default;
};

struct EnergyLedger {
  Sum start = 0;
  Sum melted = 0;       // energy of freshly melted cells
  Sum added = 0;        // brought by vents
  Sum removed = 0;      // left through drains
  Sum reheated = 0;     // extra `reheat`
  Sum accelerated = 0;  // gained (beta > 1) or lost (beta < 1) in falling
  Sum dissipated = 0;   // friction, alpha < 1
  Sum capped = 0;       // lost to the bound energy <= amount
  Sum expected() const {
    return start + melted + added - removed + reheated + accelerated - dissipated - capped;
  }
  friend bool operator==(const EnergyLedger&, const EnergyLedger&) = default;
};

struct HeatLedger {
  Sum start = 0;
  Sum conducted = 0;  // pair flows between cells of different amount change the sum of amount x heat
  Sum convected = 0;  // the same for convection in liquid
  Sum radiated = 0;   // from point sources
  Sum warmed = 0;     // gained from air
  Sum cooled = 0;     // lost to air
  Sum added = 0;      // brought by vents
  Sum removed = 0;    // left through drains
  Sum rounded = 0;    // rounding of the mean where liquid mixes (either sign)
  Sum expected() const {
    return start + conducted + convected + radiated + warmed - cooled + added - removed + rounded;
  }
  friend bool operator==(const HeatLedger&, const HeatLedger&) = default;
};

struct Ledger {
  MassLedger mass;
  EnergyLedger energy;
  HeatLedger heat;

  static Ledger open(const Volume& volume);
  friend bool operator==(const Ledger&, const Ledger&) = default;
};

// What the state holds minus what the books say; all zero when they balance.
struct Drift {
  Sum mass = 0, energy = 0, heat = 0;
  bool none() const { return mass == 0 && energy == 0 && heat == 0; }
};

Drift drift(const Ledger& ledger, const Volume& volume);

}  // namespace voxmelt::state
