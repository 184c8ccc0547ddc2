// The loops tell how fast one thread does the operations that the automaton is made of.
#pragma once

#include <cstddef>
#include <cstdint>

namespace voxmelt::measure {

// Each loop runs `rounds` rounds and returns the number of lanes operated on. `sink` keeps the compiler from
// leaving out the work.
struct LaneLoops {
  std::uint64_t (*multiply)(std::uint64_t rounds, std::uint16_t* sink) = nullptr;  // (a b) >> 16
  std::uint64_t (*add)(std::uint64_t rounds, std::uint16_t* sink) = nullptr;
  // Adds something to every number, in place. `at` is 64-byte aligned, and `lanes` is a multiple of 32.
  void (*update)(std::uint16_t* at, std::size_t lanes) = nullptr;
};

// Returns the loops, compiled for an architecture of xsimd (lane_loops_for.h).
template <class Arch>
LaneLoops loops_for();

}  // namespace voxmelt::measure
