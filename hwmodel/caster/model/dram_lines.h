// Lines from a DRAM: each is so many bursts of 64 bytes. A line returns when its last burst has come. The
// lines of one pipe return in the order in which they were asked for: no cache needs that, but a memory with
// little room between itself and the machine gives no other order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <fstream>
#include <memory>
#include <optional>
#include <vector>

#include "hwmodel/caster/model/line_memory.h"
#include "hwmodel/memory/dram.h"
#include "hwmodel/memory/trace.h"

namespace voxmelt::hwmodel::raycast {

class DramLines final : public LineMemory, private memory::PortClient {
 public:
  // It has the DRAM for itself.
  DramLines(Memory& memory, const Configuration& configuration);
  // The DRAM is shared: its owner ends its cycles. The bytes here begin at `base` of its addresses.
  DramLines(Memory& memory, memory::Dram& shared, std::int64_t base);

  void connect(Fifo<LineRequest>& requests, Fifo<LineReply>& replies) override;
  void begin() override {}
  void share(Neighbour* neighbour) override { neighbour_ = neighbour; }
  bool cycle(std::int64_t now) override;
  const MemoryCounts& counts() const override { return counts_; }
  std::optional<memory::Counts> dram_counts() const override { return dram_.counts(); }

 private:
  struct Line {
    LineReply reply;
    int bursts_left = 0;
  };
  struct Port {
    Fifo<LineRequest>* requests = nullptr;
    Fifo<LineReply>* replies = nullptr;
    int dram_port = 0;
    std::deque<Line> lines;             // asked for
    std::int64_t next = 0, bursts = 0;  // of the request that is handed on: address, how many more
    std::uint32_t id = 0;
    bool write = false;
  };

  void performed(const memory::Request& request) override;
  std::int64_t neighbour_base() const;
  bool give_reply(Port& port);
  bool hand_on(Port& port);
  void accept(Port& port);

  Memory& memory_;
  std::unique_ptr<memory::Dram> own_;
  memory::Dram& dram_;
  std::int64_t base_ = 0;
  Neighbour* neighbour_ = nullptr;
  std::vector<Port> ports_;
  std::size_t turn_ = 0;
  std::vector<std::array<std::uint8_t, kBurst>> writes_;  // bytes under way, by id
  std::vector<std::uint32_t> free_;
  MemoryCounts counts_;
  std::ofstream trace_file_;
  std::optional<memory::TraceWriter> trace_;
};

}  // namespace voxmelt::hwmodel::raycast
