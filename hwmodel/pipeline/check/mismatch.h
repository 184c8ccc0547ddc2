// A mismatch is the first difference between the hardware model and the software. It tells where, when and
// what.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/phase.h"

namespace voxmelt::hwmodel {

struct Mismatch {
  enum class Kind : std::uint8_t {
    stage,     // a stage gave another state than the reference
    channel,   // a token left a channel other than it entered
    memory,    // the written volume is not the reference's
    books,     // the writer's sums over a pass are not what the reference holds
    software,  // a software kernel differs from the reference
    asleep,    // a tile of a software kernel sleeps beside a cell that was changed
    missing,   // the reference changed something in a phase for which the pipeline has no stage
    width,     // a value did not fit its wire
    address,   // a stage addressed what its memory does not have
    halo,      // a tile owns a cell that depends on others which the tile has not
    cycles,    // nothing stalled, and the pass did not take the cycles of the closed form
    hang,      // nothing moves any more
  };
  Kind kind = Kind::stage;
  std::string where{};                 // stage, channel or implementation
  std::optional<step::Phase> phase{};  // none: the phase is not known
  std::uint32_t step = 0;
  int cascade = 0, lane = 0;
  std::int64_t cycle = 0;  // cycle of the pass; 0 in software
  int x = 0, y = 0, z = 0;
  std::string field{};
  std::int64_t expected = 0, actual = 0;
  std::string detail{};  // a hang's channels, a width's message, or the stages that waited
  std::vector<std::string> neighbourhood{};  // lines: the cells around, as they were before the phase
};

const char* name_of(Mismatch::Kind kind);

// Returns the lines that a person reads.
std::string text_of(const Mismatch& mismatch);

// Describes the cells around one, with state and amount. There are three lines per height, from above to
// below.
std::vector<std::string> neighbourhood(const state::Volume& volume, int x, int y, int z);

struct Difference {
  int x = 0, y = 0, z = 0;
  std::string field;  // empty: no difference
  std::int64_t expected = 0, actual = 0;
};
Difference first_difference(const state::Volume& expected, const state::Volume& actual);

}  // namespace voxmelt::hwmodel
