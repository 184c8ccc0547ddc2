// The pipeline as the memory sees it: how many bytes it moves in which cycle. The pipeline itself is
// simulated with a memory that always answers; its twin repeats the passes on a memory that somebody else
// uses, too.
//
// The twin is rigid. Where the bus has no room, all of the pipeline waits for that cycle. It is exact where
// the bus has room; the real one may hide a short wait in its channels.
#pragma once

#include <cstdint>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/line_memory.h"

namespace voxmelt::hwmodel {

// Passes one after the other, as they were simulated. Words are packed: the stream is read and written in its
// order, so that only its last burst is not full.
struct StreamWork {
  std::int64_t passes = 0, cycles = 0;
  std::int64_t lag = 0;  // of a pass: cycles between its first token read and its first one written
  std::int64_t tokens = 0;
  std::int64_t read_bits = 0, fed_bits = 0, written_bits = 0;

  std::int64_t bytes() const { return (read_bits + 7) / 8 + (fed_bits + 7) / 8 + (written_bits + 7) / 8; }
  friend StreamWork operator-(const StreamWork& a, const StreamWork& b);
};

class StreamTwin final : public raycast::Neighbour {
 public:
  // The first words of a pass come after `latency` cycles; a DRAM has a latency of its own.
  explicit StreamTwin(int latency) : latency_(latency) {}

  void begin(const StreamWork& work);
  std::int64_t cycle(bool has_room) override;
  void cycle(memory::Dram& dram, std::int64_t base) override;
  bool done() const override { return pass_ == work_.passes; }
  std::int64_t cycles() const { return cycles_; }  // until it was done
  std::int64_t waited() const { return waited_; }  // of them: for the memory

 private:
  // What a cycle of the pipeline reads and writes.
  struct Bits {
    std::int64_t read = 0, fed = 0, written = 0;
  };
  // A stream that is read from a DRAM, burst by burst and ahead.
  struct Input {
    int port = -1;
    std::int64_t address = 0, asked = 0, come = 0, used = 0;  // bits, of the pass
  };

  void begin_pass();
  std::int64_t in_pass(std::int64_t bits) const;
  Bits now() const;
  void end_pass();
  void fetch(memory::Dram& dram, Input& from, std::int64_t bits) const;
  void write(memory::Dram& dram, std::int64_t base);

  StreamWork work_;
  std::int64_t latency_;
  std::int64_t pass_ = 0, at_ = 0, end_ = 0;  // of the pass: the present cycle, and how many there are
  std::int64_t bits_ = 0, moved_ = 0;         // asked for so far; bytes moved
  std::int64_t cycles_ = 0, waited_ = 0;
  Input state_, irradiance_;
  int writer_ = -1;
  std::int64_t unwritten_ = 0, written_ = 0;  // bits, for a DRAM; bytes of the pass
};

// Alone on the memory: the cycles that this work takes.
std::int64_t cycles_alone(const StreamWork& work, const raycast::Configuration& memory);

}  // namespace voxmelt::hwmodel
