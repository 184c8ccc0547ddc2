// The terms of the ledgers (docs/automaton.md, "Ledgers") stand in tables, each with its name and its sign.
// Sums, booking, the balance and report.json follow from these tables.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace voxmelt::state {

template <class Terms, class Number>
struct Term {
  std::string_view name;
  int sign;  // +1: the state's holdings grow by the term; -1: they shrink
  Number Terms::*value;
};

template <class Number>
struct MassTerms {
  Number added = 0;    // brought by vents
  Number removed = 0;  // left through drains

  static constexpr auto table() {
    using Row = Term<MassTerms, Number>;
    return std::array{Row{"added", +1, &MassTerms::added}, Row{"removed", -1, &MassTerms::removed}};
  }
  friend bool operator==(const MassTerms&, const MassTerms&) = default;
};

template <class Number>
struct EnergyTerms {
  Number melted = 0;       // energy of freshly melted cells
  Number frozen = 0;       // energy that freezing cells lose
  Number added = 0;        // brought by vents
  Number removed = 0;      // left through drains
  Number reheated = 0;     // extra `reheat`
  Number accelerated = 0;  // gained (beta > 1) or lost (beta < 1) in falling
  Number dissipated = 0;   // friction, alpha < 1
  Number capped = 0;       // lost to the bound energy <= amount

  static constexpr auto table() {
    using Row = Term<EnergyTerms, Number>;
    return std::array{
        Row{"melted", +1, &EnergyTerms::melted},         Row{"frozen", -1, &EnergyTerms::frozen},
        Row{"added", +1, &EnergyTerms::added},           Row{"removed", -1, &EnergyTerms::removed},
        Row{"reheated", +1, &EnergyTerms::reheated},     Row{"accelerated", +1, &EnergyTerms::accelerated},
        Row{"dissipated", -1, &EnergyTerms::dissipated}, Row{"capped", -1, &EnergyTerms::capped}};
  }
  friend bool operator==(const EnergyTerms&, const EnergyTerms&) = default;
};

template <class Number>
struct HeatTerms {
  Number conducted = 0;  // pair flows between cells of different amount change the sum of amount x heat
  Number walls = 0;      // conducted from isothermal walls, less what was conducted to them
  Number convected = 0;  // the same for convection in liquid
  Number radiated = 0;   // from point sources
  Number warmed = 0;     // gained from air
  Number cooled = 0;     // lost to air
  Number melted = 0;     // between the heats of two materials at one temperature, as the one melts
  Number added = 0;      // brought by vents
  Number removed = 0;    // left through drains
  Number rounded = 0;    // rounding of the mean where liquid mixes (either sign)

  static constexpr auto table() {
    using Row = Term<HeatTerms, Number>;
    return std::array{Row{"conducted", +1, &HeatTerms::conducted}, Row{"walls", +1, &HeatTerms::walls},
                      Row{"convected", +1, &HeatTerms::convected}, Row{"radiated", +1, &HeatTerms::radiated},
                      Row{"warmed", +1, &HeatTerms::warmed},       Row{"cooled", -1, &HeatTerms::cooled},
                      Row{"melted", +1, &HeatTerms::melted},       Row{"added", +1, &HeatTerms::added},
                      Row{"removed", -1, &HeatTerms::removed},     Row{"rounded", +1, &HeatTerms::rounded}};
  }
  friend bool operator==(const HeatTerms&, const HeatTerms&) = default;
};

// Adds every term of one ledger to that of another, which may hold wider numbers.
template <template <class> class Terms, class To, class From>
constexpr void add_terms(Terms<To>& to, const Terms<From>& from) {
  constexpr auto sums = Terms<To>::table();
  constexpr auto terms = Terms<From>::table();
  static_assert(sizeof(Terms<To>) == sums.size() * sizeof(To), "a term without a row");
  for (std::size_t i = 0; i < sums.size(); ++i) to.*sums[i].value += from.*terms[i].value;
}

// Counts the liquid in settled runs of the viscous law, over all sub-steps, and the part whose mobility a
// limit cuts.
template <class Number>
struct LimitCounts {
  Number cells = 0, limited_cells = 0;
  Number mass = 0, limited_mass = 0;

  template <class From>
  void add(const LimitCounts<From>& more) {
    cells += more.cells;
    limited_cells += more.limited_cells;
    mass += more.mass;
    limited_mass += more.limited_mass;
  }
  friend bool operator==(const LimitCounts&, const LimitCounts&) = default;
};

// Holds the terms of all ledgers.
template <class Number>
struct LedgerTerms {
  MassTerms<Number> mass;
  EnergyTerms<Number> energy;
  HeatTerms<Number> heat;
  LimitCounts<Number> limit;  // not a ledger, as it has no balance

  LedgerTerms& operator+=(const LedgerTerms& other) {
    add_terms(mass, other.mass);
    add_terms(energy, other.energy);
    add_terms(heat, other.heat);
    limit.add(other.limit);
    return *this;
  }
};

}  // namespace voxmelt::state
