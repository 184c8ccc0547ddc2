// Two ledgers are compared term by term.
#pragma once

#include <optional>
#include <string>

#include "kernel/automaton/state/ledger.h"

namespace voxmelt::state {

struct LedgerDifference {
  std::string term;  // "mass: removed"
  Sum expected = 0, actual = 0;
};

// Returns the first term in which two ledgers differ, or none.
std::optional<LedgerDifference> first_difference(const Ledger& expected, const Ledger& actual);

}  // namespace voxmelt::state
