/// @file
/// The exact books of mass, energy and heat stand here (docs/automaton.md, section 12). Every term is summed
/// where a rule applies it. None is found by subtraction. So the books check the rules: the holdings of a
/// state must be start + all terms, to the unit.
#pragma once

#include <string>
#include <vector>

namespace voxmelt {

/// Holds a sum over all cells and steps, exact in 128 bits.
__extension__ using Sum = __int128;

/// Returns the decimal digits, with a minus sign if the value is negative.
std::string to_string(Sum value);

/// Names one cause of change, with its sum since the start.
struct Term {
  std::string name;  ///< "added", "conducted", ...: as in report.json and in section 12
  Sum value = 0;     ///< signed: matter removed, heat cooled, energy dissipated or capped is negative
};

/// Keeps the books of one quantity.
struct Ledger {
  Sum start = 0;            ///< holdings of the first state
  std::vector<Term> terms;  ///< all causes of change
  Sum held = 0;             ///< holdings of the present state, counted anew

  /// Returns the holdings of the state minus those that the books expect. It is 0 when they balance.
  Sum drift() const {
    Sum expected = start;
    for (const Term& term : terms) expected += term.value;
    return held - expected;
  }
};

/// Keeps all books of a run.
struct Ledgers {
  Ledger mass;    ///< sum of amount over solid and liquid, in 1/4096 of a full cell
  Ledger energy;  ///< sum of energy, in the same unit
  Ledger heat;    ///< sum of amount x heat over solid and liquid

  /// Tells if no ledger has a drift.
  bool balance() const { return mass.drift() == 0 && energy.drift() == 0 && heat.drift() == 0; }
};

}  // namespace voxmelt
