// The books of a run are turned into the form that the public face shows.
#pragma once

#include "kernel/automaton/state/ledger.h"
#include "voxmelt/ledgers.h"

namespace voxmelt::library {

Ledgers to_ledgers(const state::Ledger& ledger, const state::Holdings& held);

}  // namespace voxmelt::library
