#include "hwmodel/memory/fixed_latency.h"

#include <algorithm>
#include <iterator>

namespace voxmelt::hwmodel::memory {

int FixedLatency::open_port(PortClient* client) {
  const auto same = std::find_if(ways_.begin(), ways_.end(),
                                 [&](const Way& way) { return client != nullptr && way.client == client; });
  ports_.push_back({static_cast<std::size_t>(same - ways_.begin()), {}});
  if (same == ways_.end()) ways_.push_back({client, {}, 0, -1});
  return static_cast<int>(ports_.size()) - 1;
}

bool FixedLatency::ready(int port) const {
  const Way& way = way_of(port);
  if (way.reads.size() + way.waiting >= kMostUnderWay) return false;
  return way.client != nullptr || streams_may_claim();
}

// Claims of others do not count. Otherwise a client that always asks would keep all streams waiting.
bool FixedLatency::streams_may_claim() const {
  if (claims_.empty()) return true;
  const Claim& first = claims_.front();
  const std::int64_t gone = std::max<std::int64_t>(0, now_ + latency_ - (first.end - first.beats));
  return claimed_ - gone < kMostClaimed;
}

void FixedLatency::put(int port, const Request& request) {
  ports_[port].inbox.push_back(request);
  ++way_of(port).waiting;
}

const Request* FixedLatency::reply(int port) const {
  const Way& way = way_of(port);
  const bool has = !way.reads.empty() && way.reads.front().port == port && way.reads.front().done <= now_ &&
                   (way.client == nullptr || way.last_reply < now_);
  return has ? &way.reads.front().request : nullptr;
}

void FixedLatency::take(int port) {
  Way& way = way_of(port);
  way.reads.pop_front();
  way.last_reply = now_;
}

bool FixedLatency::cycle() {
  bool moved = false;
  for (int i = 0; i < std::ssize(ports_); ++i) {
    Port& port = ports_[i];
    for (; !port.inbox.empty(); port.inbox.pop_front(), moved = true) serve(i, port.inbox.front());
    ways_[port.way].waiting = 0;
  }
  ++now_;
  for (; !claims_.empty() && claims_.front().end <= now_ + latency_; claims_.pop_front())
    claimed_ -= claims_.front().beats;
  return moved;
}

void FixedLatency::serve(int port, const Request& request) {
  Way& way = way_of(port);
  std::int64_t bytes = request.bytes;
  if (way.client == nullptr) {  // a stream: its bytes fill whole cycles, one after another
    bytes = owed_ + bytes;
    owed_ = bytes % bus_bytes_;
    bytes -= owed_;
  }
  const std::int64_t beats = (bytes + bus_bytes_ - 1) / bus_bytes_;
  bus_cycles_ += beats;
  bus_free_ = std::max(bus_free_, now_ + (request.write ? 1 : latency_)) + beats;
  if (way.client == nullptr && beats > 0) {
    claims_.push_back({bus_free_, beats});
    claimed_ += beats;
  }
  if (!request.write) way.reads.push_back({request, port, bus_free_});
  if (way.client != nullptr) way.client->performed(request);
}

bool FixedLatency::works() const {
  return std::any_of(ports_.begin(), ports_.end(), [](const Port& port) { return !port.inbox.empty(); }) ||
         std::any_of(ways_.begin(), ways_.end(),
                     [&](const Way& way) { return !way.reads.empty() && way.reads.back().done > now_; });
}

bool FixedLatency::idle() const {
  return std::all_of(ports_.begin(), ports_.end(), [](const Port& port) { return port.inbox.empty(); }) &&
         std::all_of(ways_.begin(), ways_.end(), [](const Way& way) { return way.reads.empty(); });
}

}  // namespace voxmelt::hwmodel::memory
