// The line block lies between the pipes and the memory. Each line is a request, or to a DRAM so many bursts
// of 64 bytes. A line returns when its last byte has come. The lines of one pipe return in the order in which
// they were asked for. No cache needs that, but a memory with little room between itself and the machine
// gives no other order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/fabric/fifo.h"
#include "hwmodel/fabric/memory_port.h"

namespace voxmelt::hwmodel::raycast {

struct LineCounts {
  std::int64_t reads = 0, read_bytes = 0, written_bytes = 0;
  std::int64_t bus_cycles = 0;  // for a memory of a fixed latency
};

class LineBlock final : private memory::PortClient {
 public:
  // The bytes here begin at address `base` of the memory. The owner of the memory ends its cycles.
  LineBlock(Memory& bytes, memory::Memory& memory, int bus_bytes, std::int64_t base = 0)
      : bytes_(bytes), memory_(memory), bus_bytes_(bus_bytes), base_(base) {}

  void connect(Fifo<LineRequest>& requests, Fifo<LineReply>& replies);
  // Takes a request from one pipe after another, one a cycle. Tells whether anything moved.
  bool cycle();
  const LineCounts& counts() const { return counts_; }

 private:
  struct Line {
    LineReply reply;
    int replies_left = 0;
  };
  struct Port {
    Fifo<LineRequest>* requests = nullptr;
    Fifo<LineReply>* replies = nullptr;
    int port = 0;                      // number of the memory's port
    std::deque<Line> lines;            // lines that were asked for
    std::int64_t next = 0, bytes = 0;  // request that is handed on: its next address, its bytes left
    std::uint32_t id = 0;
    bool write = false;
  };

  void performed(const memory::Request& request) override;
  bool give_reply(Port& port);
  bool hand_on(Port& port);
  void accept(Port& port);
  std::int32_t bytes_at_once(std::int64_t bytes) const;

  Memory& bytes_;
  memory::Memory& memory_;
  int bus_bytes_;
  std::int64_t base_;
  std::vector<Port> ports_;
  std::size_t turn_ = 0;
  std::vector<std::array<std::uint8_t, kBurst>> writes_;  // bytes under way, by id
  std::vector<std::uint32_t> free_;
  LineCounts counts_;
};

}  // namespace voxmelt::hwmodel::raycast
