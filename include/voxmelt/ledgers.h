/// @file
/// The exact books of mass, energy and heat (docs/automaton.md, section 12). Every term is summed where a
/// rule applies it. None is found by subtraction. So the books check the rules: what a state holds must be
/// start + all terms, to the unit.
#pragma once

#include <string>
#include <vector>

namespace voxmelt {

/// A sum over all cells and steps, exact in 128 bits.
__extension__ using Sum = __int128;

/// Decimal digits, with a minus sign if negative.
std::string to_string(Sum value);

/// One cause of change, summed since the start.
struct Term {
  std::string name;  ///< "added", "conducted", ...: as in report.json and in section 12
  Sum value = 0;     ///< with its sign: what was removed, cooled, dissipated or capped is negative
};

/// The books of one quantity.
struct Ledger {
  Sum start = 0;            ///< what the first state held
  std::vector<Term> terms;  ///< what has changed it
  Sum held = 0;             ///< what the present state holds, counted anew

  /// What the state holds minus what the books say; 0 when they balance.
  Sum drift() const {
    Sum expected = start;
    for (const Term& term : terms) expected += term.value;
    return held - expected;
  }
};

/// All books of a run.
struct Ledgers {
  Ledger mass;    ///< sum of amount over solid and liquid, in 1/4096 of a full cell
  Ledger energy;  ///< sum of energy, in the same unit
  Ledger heat;    ///< sum of amount x heat over solid and liquid

  /// No ledger has a drift.
  bool balance() const { return mass.drift() == 0 && energy.drift() == 0 && heat.drift() == 0; }
};

}  // namespace voxmelt
