#include "hwmodel/caster/model/line_block.h"

#include <algorithm>
#include <cstring>

namespace voxmelt::hwmodel::raycast {

void LineBlock::connect(Fifo<LineRequest>& requests, Fifo<LineReply>& replies) {
  Port& port = ports_.emplace_back();
  port.requests = &requests;
  port.replies = &replies;
  port.port = memory_.open_port(this);
}

bool LineBlock::cycle() {
  bool moved = false;
  for (Port& port : ports_) {
    moved |= give_reply(port);
    moved |= hand_on(port);
  }
  for (std::size_t i = 0; i < ports_.size(); ++i) {
    const std::size_t at = (turn_ + i) % ports_.size();
    Port& port = ports_[at];
    if (port.bytes > 0 || !port.requests->valid() || !memory_.ready(port.port)) continue;
    accept(port);
    hand_on(port);
    turn_ = (at + 1) % ports_.size();
    return true;
  }
  return moved;
}

// Bursts are taken as they come, and wait here for the others of their line. A whole line waits in the
// memory.
bool LineBlock::give_reply(Port& port) {
  bool moved = false;
  const bool bursts = memory_.most_bytes() == kBurst;
  while (!port.lines.empty() && port.lines.front().replies_left > 0 && (bursts || port.replies->ready()) &&
         memory_.reply(port.port) != nullptr) {
    memory_.take(port.port);
    --port.lines.front().replies_left;
    moved = true;
  }
  if (port.lines.empty() || port.lines.front().replies_left > 0 || !port.replies->ready()) return moved;
  *port.replies->put() = port.lines.front().reply;
  port.lines.pop_front();
  return true;
}

std::int32_t LineBlock::bytes_at_once(std::int64_t bytes) const {
  const int most = memory_.most_bytes();
  return most == kBurst ? kBurst : static_cast<std::int32_t>(std::min<std::int64_t>(bytes, most));
}

void LineBlock::accept(Port& port) {
  const LineRequest& request = *port.requests->get();
  port.next = request.address;
  port.bytes = request.bytes;
  port.write = request.write;
  port.id = 0;
  counts_.bus_cycles += (request.bytes + bus_bytes_ - 1) / bus_bytes_;
  if (!request.write) {
    ++counts_.reads;
    counts_.read_bytes += request.bytes;
    const std::int32_t at_once = bytes_at_once(request.bytes);
    port.lines.push_back({{request.client, request.slot, request.address, request.bytes},
                          (request.bytes + at_once - 1) / at_once});
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

// Hands on as much as the memory takes now.
bool LineBlock::hand_on(Port& port) {
  bool moved = false;
  while (port.bytes > 0 && memory_.ready(port.port)) {
    const std::int32_t bytes = bytes_at_once(port.bytes);
    memory_.put(port.port, {base_ + port.next, port.id, port.write, bytes});
    port.next += bytes;
    port.bytes -= bytes;
    moved = true;
  }
  return moved;
}

void LineBlock::performed(const memory::Request& request) {
  if (!request.write) return;
  std::memcpy(bytes_.bytes.data() + (request.address - base_), writes_[request.id].data(), request.bytes);
  counts_.written_bytes += request.bytes;
  free_.push_back(request.id);
}

}  // namespace voxmelt::hwmodel::raycast
