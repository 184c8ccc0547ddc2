// The digest is one 64-bit number for a whole state (docs/automaton.md, "State digest"). It is a sum over
// cells, so it can be taken in any order, by any number of threads, stages or machines.
#pragma once

#include <cstdint>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::state {

inline std::uint64_t mixed_bits(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
  return v ^ (v >> 31);
}

// Returns 0 for an empty cell, so empty space costs nothing.
inline std::uint64_t cell_digest(std::uint64_t index, std::uint64_t packed) {
  return packed == 0 ? 0 : mixed_bits(packed + 0x9E3779B97F4A7C15u * (index + 1));
}

std::uint64_t digest(const Volume& volume);

}  // namespace voxmelt::state
