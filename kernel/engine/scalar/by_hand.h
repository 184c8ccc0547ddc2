// Matter is poured and carved by hand between two steps, in plain loops (docs/automaton.md, section 16).
#pragma once

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/ledger.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::scalar {

// Tells if the centre of a cell of the grid is in the region.
bool meets(const rule::Region& region, const state::Grid& grid);

// Both book what they do, and return the rows that have changed.
//
// Fills each cell of air of the region with liquid, as much as a full cell holds.
state::ChangedRows pour(const rule::Region& region, rule::Temperature temperature,
                        const rule::Parameters& parameters, state::Volume& volume, state::Ledger& ledger);
// Takes solid and liquid out of all cells of the region. Inert cells stay.
state::ChangedRows carve(const rule::Region& region, state::Volume& volume, state::Ledger& ledger);

}  // namespace voxmelt::scalar
