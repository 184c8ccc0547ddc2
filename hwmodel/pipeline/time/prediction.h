// The prediction tells how many cycles passes take when nothing stalls, from the configuration alone.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

// N tokens pass, each `interval` cycles after the one before it. Every channel holds a token for one cycle.
// Every stage holds it until the stage has moved `lag` times. It moves at the pace of its input while that
// lasts, then at its own.
//
//   cycles = interval (N - 1) + sum of waits + channels + 1
//   wait   = interval lag                          where lag < N
//            interval (N - 1) + lag - N + 1        else (grids thinner than the stencil)
//   interval = 1; 2 where channels hold one token only
//
// In a train, the tokens of the next pass follow those of the last one. N counts all of them, and the waits
// are those of the first pass. Later passes have no more steps, and wait for the stages that they leave out.
// Each tile is streamed like a pass, and `streams` counts them.
std::int64_t predicted_cycles(const Design& design, const Configuration& configuration, const Pass& first,
                              std::int64_t streams = 1);
// Predicts the cycles of so many equal passes of the whole grid, one after another.
std::int64_t predicted_passes(const Design& design, const Configuration& configuration, const Pass& pass,
                              std::int64_t passes);

// Returns true if a pass of as many steps may follow this one without a gap. Every token must come back
// before the reader asks for it again. Otherwise stages would wait for tokens that wait in them.
bool passes_overlap(const Design& design, const Configuration& configuration, const Pass& pass);

// Returns true if the next tile of a pass may follow without a gap. No tile waits for another one of its
// pass. But no stage may hold tokens of three tiles.
bool tiles_follow(const Design& design, const Configuration& configuration, const Pass& pass);

}  // namespace voxmelt::hwmodel
