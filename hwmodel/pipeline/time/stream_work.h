// Stream work is what the pipeline moves to and from its memory.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel {

// Sums passes one after the other, as they were simulated. Words are packed. The stream is read and written
// in its order, so only its last burst is not full.
struct StreamWork {
  std::int64_t passes = 0, cycles = 0;
  std::int64_t lag = 0;  // cycles of a pass between its first token read and its first one written
  std::int64_t tokens = 0;
  std::int64_t read_bits = 0, fed_bits = 0, written_bits = 0;

  std::int64_t bytes() const { return (read_bits + 7) / 8 + (fed_bits + 7) / 8 + (written_bits + 7) / 8; }
  friend StreamWork operator-(const StreamWork& a, const StreamWork& b) {
    StreamWork work = a;
    work.passes -= b.passes;
    work.cycles -= b.cycles;
    work.tokens -= b.tokens;
    work.read_bits -= b.read_bits;
    work.fed_bits -= b.fed_bits;
    work.written_bits -= b.written_bits;
    return work;
  }
};

}  // namespace voxmelt::hwmodel
