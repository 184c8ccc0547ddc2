#include <string>

#include "library/ledgers.h"

namespace voxmelt {

std::string to_string(Sum value) { return state::to_string(value); }

namespace library {

Ledgers to_ledgers(const state::Ledger& ledger, const state::Holdings& held) {
  const state::MassLedger& m = ledger.mass;
  const state::EnergyLedger& e = ledger.energy;
  const state::HeatLedger& h = ledger.heat;
  return {{m.start, {{"added", m.added}, {"removed", -m.removed}}, held.solid + held.liquid},
          {e.start,
           {{"melted", e.melted},
            {"added", e.added},
            {"removed", -e.removed},
            {"reheated", e.reheated},
            {"accelerated", e.accelerated},
            {"dissipated", -e.dissipated},
            {"capped", -e.capped}},
           held.energy},
          {h.start,
           {{"conducted", h.conducted},
            {"convected", h.convected},
            {"radiated", h.radiated},
            {"warmed", h.warmed},
            {"cooled", -h.cooled},
            {"added", h.added},
            {"removed", -h.removed},
            {"rounded", h.rounded}},
           held.heat}};
}

}  // namespace library
}  // namespace voxmelt
