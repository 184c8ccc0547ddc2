// What gives lines to the pipes: a memory of a fixed latency (memory_port.h), or a DRAM (dram_lines.h).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/fabric/fifo.h"
#include "hwmodel/memory/counts.h"

namespace voxmelt::hwmodel::memory {
class Dram;
}

namespace voxmelt::hwmodel::raycast {

struct MemoryCounts {
  std::int64_t reads = 0, read_bytes = 0, written_bytes = 0, bus_cycles = 0;
  std::optional<memory::Counts> dram;
};

// Another machine that uses the memory, too. It moves no bytes of the ray caster's.
class Neighbour {
 public:
  virtual ~Neighbour() = default;
  // A cycle on a memory of a fixed latency: how many bytes it moves. Where the bus has no room it waits.
  virtual std::int64_t cycle(bool has_room) = 0;
  // A cycle on a DRAM, of which the addresses from `base` on are its own.
  virtual void cycle(memory::Dram& dram, std::int64_t base) = 0;
  virtual bool done() const = 0;
};

class LineMemory {
 public:
  virtual ~LineMemory() = default;
  virtual void connect(Fifo<LineRequest>& requests, Fifo<LineReply>& replies) = 0;
  virtual void begin() = 0;                      // cycles count from 0 again
  virtual void share(Neighbour* neighbour) = 0;  // null: with nobody
  // Tells whether anything moved.
  virtual bool cycle(std::int64_t now) = 0;
  virtual const MemoryCounts& counts() const = 0;
  virtual std::optional<memory::Counts> dram_counts() const { return {}; }
};

std::unique_ptr<LineMemory> make_line_memory(Memory& memory, const Configuration& configuration);

}  // namespace voxmelt::hwmodel::raycast
