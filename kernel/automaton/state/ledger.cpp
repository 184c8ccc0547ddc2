#include "kernel/automaton/state/ledger.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>

namespace voxmelt::state {

std::string to_string(Sum value) {
  if (value == 0) return "0";
  const bool negative = value < 0;
  std::string digits;
  for (; value != 0; value /= 10) {
    const int digit = static_cast<int>(value % 10);
    digits += static_cast<char>('0' + (digit < 0 ? -digit : digit));
  }
  if (negative) digits += '-';
  std::reverse(digits.begin(), digits.end());
  return digits;
}

Holdings holdings(const Volume& volume) {
  const Grid g = volume.grid;
  std::uint64_t solid = 0, liquid = 0, energy = 0, heat = 0;  // a grid of 2^32 cells fits
  for (int z = 0; z < g.z; ++z)
    for (int y = 0; y < g.y; ++y) {
      const auto solids = volume.solid.row(y, z), liquids = volume.liquid.row(y, z);
      for (int w = 0; w < std::ssize(solids); ++w)
        for (std::uint64_t matter = solids[w] | liquids[w]; matter != 0; matter &= matter - 1) {
          const int bit = std::countr_zero(matter);
          const Slot i = volume.at(64 * w + bit, y, z);
          (solids[w] >> bit & 1u ? solid : liquid) += volume.amount[i];
          energy += volume.energy[i];
          heat += std::uint64_t{volume.amount[i]} * volume.heat[i];
        }
    }
  return {solid, liquid, energy, heat};
}

Ledger Ledger::open(const Volume& volume) {
  const Holdings held = holdings(volume);
  Ledger ledger;
  ledger.mass.start = held.solid + held.liquid;
  ledger.energy.start = held.energy;
  ledger.heat.start = held.heat;
  return ledger;
}

void Ledger::book(const LedgerTerms<std::int64_t>& terms) {
  add_terms<MassTerms>(mass, terms.mass);
  add_terms<EnergyTerms>(energy, terms.energy);
  add_terms<HeatTerms>(heat, terms.heat);
  limit.add(terms.limit);
}

Drift drift(const Ledger& ledger, const Volume& volume) {
  const Holdings held = holdings(volume);
  return {held.solid + held.liquid - ledger.mass.expected(), held.energy - ledger.energy.expected(),
          held.heat - ledger.heat.expected()};
}

}  // namespace voxmelt::state
