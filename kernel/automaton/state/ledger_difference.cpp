#include "kernel/automaton/state/ledger_difference.h"

namespace voxmelt::state {
namespace {

template <template <class> class Terms>
std::optional<LedgerDifference> differing_term(const char* ledger, const LedgerOf<Terms>& expected,
                                               const LedgerOf<Terms>& actual) {
  if (expected.start != actual.start)
    return LedgerDifference{std::string(ledger) + ": start", expected.start, actual.start};
  for (const auto& term : Terms<Sum>::table())
    if (expected.*term.value != actual.*term.value)
      return LedgerDifference{std::string(ledger) + ": " + std::string(term.name), expected.*term.value,
                              actual.*term.value};
  return {};
}

}  // namespace

std::optional<LedgerDifference> first_difference(const Ledger& expected, const Ledger& actual) {
  if (auto found = differing_term<MassTerms>("mass", expected.mass, actual.mass)) return found;
  if (auto found = differing_term<EnergyTerms>("energy", expected.energy, actual.energy)) return found;
  if (auto found = differing_term<HeatTerms>("heat", expected.heat, actual.heat)) return found;
  const auto &e = expected.limit, &a = actual.limit;
  if (e.cells != a.cells) return LedgerDifference{"limit: cells", e.cells, a.cells};
  if (e.limited_cells != a.limited_cells)
    return LedgerDifference{"limit: limited cells", e.limited_cells, a.limited_cells};
  if (e.mass != a.mass) return LedgerDifference{"limit: mass", e.mass, a.mass};
  if (e.limited_mass != a.limited_mass)
    return LedgerDifference{"limit: limited mass", e.limited_mass, a.limited_mass};
  return {};
}

}  // namespace voxmelt::state
