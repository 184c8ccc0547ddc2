#include "hwmodel/caster/model/dram_lines.h"

#include <cstring>
#include <stdexcept>

#include "hwmodel/caster/model/memory_port.h"

namespace voxmelt::hwmodel::raycast {

std::unique_ptr<LineMemory> make_line_memory(Memory& memory, const Configuration& configuration) {
  if (configuration.dram) return std::make_unique<DramLines>(memory, configuration);
  return std::make_unique<MemoryBlock>(memory, configuration.latency, configuration.bus_bytes);
}

DramLines::DramLines(Memory& memory, const Configuration& c)
    : memory_(memory), own_(std::make_unique<memory::Dram>(*c.dram, c.clock_mhz)), dram_(*own_) {
  if (c.memory_trace.empty()) return;
  trace_file_.open(c.memory_trace);
  if (!trace_file_) throw std::runtime_error(c.memory_trace + ": error: cannot be written");
  trace_.emplace(trace_file_, c.memory_trace.ends_with(".stl") ? memory::TraceFormat::dramsys
                                                               : memory::TraceFormat::ramulator);
  dram_.trace(&*trace_);
}

DramLines::DramLines(Memory& memory, memory::Dram& shared, std::int64_t base)
    : memory_(memory), dram_(shared), base_(base) {}

void DramLines::connect(Fifo<LineRequest>& requests, Fifo<LineReply>& replies) {
  Port& port = ports_.emplace_back();
  port.requests = &requests, port.replies = &replies;
  port.dram_port = dram_.open_port(this);
}

bool DramLines::cycle(std::int64_t) {
  bool moved = false;
  for (Port& port : ports_) {
    moved |= give_reply(port);
    moved |= hand_on(port);
  }
  // One pipe after the other, as the memory of a fixed latency.
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const std::size_t at = (turn_ + i) % ports_.size();
    Port& port = ports_[at];
    if (port.bursts > 0 || !port.requests->valid() || !dram_.ready(port.dram_port)) continue;
    accept(port);
    hand_on(port);
    turn_ = (at + 1) % ports_.size();
    moved = true;
    break;
  }
  if (neighbour_ != nullptr) neighbour_->cycle(dram_, neighbour_base());
  if (own_) moved |= dram_.cycle();
  return moved;
}

// Behind the bytes here, at the begin of a row of every bank.
std::int64_t DramLines::neighbour_base() const {
  const memory::Parameters& p = dram_.parameters();
  const std::int64_t rows = p.row_bytes() * p.banks_of_rank() * p.ranks * p.channels;
  return (base_ + static_cast<std::int64_t>(memory_.bytes.size()) + rows - 1) / rows * rows;
}

bool DramLines::give_reply(Port& port) {
  bool moved = false;
  while (!port.lines.empty() && port.lines.front().bursts_left > 0 &&
         dram_.reply(port.dram_port) != nullptr) {
    dram_.take(port.dram_port);
    --port.lines.front().bursts_left;
    moved = true;
  }
  if (port.lines.empty() || port.lines.front().bursts_left > 0 || !port.replies->ready()) return moved;
  *port.replies->put() = port.lines.front().reply;
  port.lines.pop_front();
  return true;
}

void DramLines::accept(Port& port) {
  const LineRequest& request = *port.requests->get();
  port.next = request.address, port.bursts = (request.bytes + kBurst - 1) / kBurst;
  port.write = request.write, port.id = 0;
  if (!request.write) {
    ++counts_.reads;
    counts_.read_bytes += request.bytes;
    port.lines.push_back(
        {{request.client, request.slot, request.address, request.bytes}, static_cast<int>(port.bursts)});
    return;
  }
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(writes_.size()));
    writes_.emplace_back();
  }
  port.id = free_.back();
  free_.pop_back();
  writes_[port.id] = request.data;
}

// As many bursts as the DRAM takes now.
bool DramLines::hand_on(Port& port) {
  bool moved = false;
  for (; port.bursts > 0 && dram_.ready(port.dram_port); --port.bursts, port.next += kBurst) {
    dram_.put(port.dram_port, {base_ + port.next, port.id, port.write});
    moved = true;
  }
  return moved;
}

void DramLines::performed(const memory::Request& request) {
  if (!request.write) return;
  std::memcpy(memory_.bytes.data() + (request.address - base_), writes_[request.id].data(), kBurst);
  counts_.written_bytes += kBurst;
  free_.push_back(request.id);
}

}  // namespace voxmelt::hwmodel::raycast
