// The memory answers after a fixed number of cycles, over a bus of a fixed number of bytes per cycle.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <limits>
#include <string_view>
#include <vector>

#include "hwmodel/fabric/memory_port.h"

namespace voxmelt::hwmodel::memory {

// Requests take the bus in the order in which they were put. Those of one cycle go in the order of their
// ports. A client's request takes whole cycles of the bus. Replies return in the order in which the client
// asked at all of its ports, one reply a cycle. Ports without a client are streams, whose bytes are packed on
// the bus.
class FixedLatency final : public Memory {
 public:
  FixedLatency(int latency, int bus_bytes) : latency_(latency), bus_bytes_(bus_bytes) {}

  int open_port(PortClient* client) override;
  bool ready(int port) const override;
  void put(int port, const Request& request) override;
  const Request* reply(int port) const override;
  void take(int port) override;
  bool cycle() override;
  bool idle() const override;
  bool works() const override;
  void require(std::int64_t, std::string_view) const override {}  // it has no end

  int most_bytes() const override { return std::numeric_limits<int>::max(); }
  std::int64_t alignment() const override { return kBurst; }

  std::int64_t bus_cycles() const { return bus_cycles_; }  // cycles that carried bytes
  // Forgets what was promised of the bus. A job begins that counts from 0.
  void begin_job() {
    bus_free_ = now_;
    claims_.clear();
    claimed_ = 0;
  }

 private:
  static constexpr std::size_t kMostUnderWay = 256;  // reads of a way back
  static constexpr std::int64_t kMostClaimed = 64;   // cycles of the bus, by all streams together
  struct UnderWay {
    Request request;
    int port = 0;
    std::int64_t done = 0;
  };
  struct Way {  // the way back to a client
    PortClient* client = nullptr;
    std::deque<UnderWay> reads;
    std::size_t waiting = 0;       // requests put in this cycle
    std::int64_t last_reply = -1;  // cycle in which the last reply was taken
  };
  struct Claim {  // a stream's claim on the bus
    std::int64_t end, beats;
  };
  struct Port {
    std::size_t way = 0;
    std::deque<Request> inbox;  // requests of this cycle
  };

  const Way& way_of(int port) const { return ways_[ports_[port].way]; }
  Way& way_of(int port) { return ways_[ports_[port].way]; }
  void serve(int port, const Request& request);
  bool streams_may_claim() const;

  int latency_, bus_bytes_;
  std::vector<Way> ways_;
  std::vector<Port> ports_;
  std::int64_t now_ = 0, bus_free_ = 0, bus_cycles_ = 0;
  std::deque<Claim> claims_;  // claims that have not come to their end
  std::int64_t claimed_ = 0;  // sum of their beats
  std::int64_t owed_ = 0;     // bytes of streams that fill no cycle yet
};

}  // namespace voxmelt::hwmodel::memory
