#include "library/ledgers.h"

#include <string>

namespace voxmelt {
namespace {

template <template <class> class Terms>
Ledger to_ledger(const state::LedgerOf<Terms>& ledger, Sum held) {
  Ledger result{ledger.start, {}, held};
  for (const auto& term : Terms<Sum>::table())
    result.terms.push_back({std::string(term.name), term.sign * (ledger.*term.value)});
  return result;
}

}  // namespace

std::string to_string(Sum value) { return state::to_string(value); }

namespace library {

Ledgers to_ledgers(const state::Ledger& ledger, const state::Holdings& held) {
  return {to_ledger(ledger.mass, held.solid + held.liquid), to_ledger(ledger.energy, held.energy),
          to_ledger(ledger.heat, held.heat)};
}

}  // namespace library
}  // namespace voxmelt
