// These are the exact books of mass, energy and heat (docs/automaton.md, "Ledgers").
//
// Every term (ledger_terms.h) is summed where a rule applies it. None is found by subtraction. A ledger
// balances when start + all terms = the holdings of the state, to the unit.
#pragma once

#include <cstdint>
#include <string>

#include "kernel/automaton/state/ledger_terms.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

__extension__ using Sum = __int128;

std::string to_string(Sum value);

// Sums what a state holds, in the units of each ledger.
struct Holdings {
  Sum solid = 0, liquid = 0;  // mass: sum of amount
  Sum energy = 0;             // sum of energy
  Sum heat = 0;               // sum of amount x heat content over solid and liquid
};

Holdings holdings(const Volume& volume);

// Is the ledger of mass, energy or heat.
template <template <class> class Terms>
struct LedgerOf : Terms<Sum> {
  Sum start = 0;
  Sum expected() const {
    Sum sum = start;
    for (const auto& term : Terms<Sum>::table()) sum += term.sign * (this->*term.value);
    return sum;
  }
  friend bool operator==(const LedgerOf&, const LedgerOf&) = default;
};
using MassLedger = LedgerOf<MassTerms>;
using EnergyLedger = LedgerOf<EnergyTerms>;
using HeatLedger = LedgerOf<HeatTerms>;

struct Ledger {
  MassLedger mass;
  EnergyLedger energy;
  HeatLedger heat;
  LimitCounts<Sum> limit;

  static Ledger open(const Volume& volume);
  void book(const LedgerTerms<std::int64_t>& terms);
  friend bool operator==(const Ledger&, const Ledger&) = default;
};

// Is what the state holds minus what the books expect. All are zero when they balance.
struct Drift {
  Sum mass = 0, energy = 0, heat = 0;
  bool none() const { return mass == 0 && energy == 0 && heat == 0; }
};

Drift drift(const Ledger& ledger, const Volume& volume);

}  // namespace voxmelt::state
