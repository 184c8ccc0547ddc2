// Between a pipe and the memory: requests of several clients on one channel, and lines back to those who
// asked.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/line_memory.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

class MemoryPort final : public Stage {
 public:
  explicit MemoryPort(const Memory& memory) : Stage("memory port"), memory_(memory) {}
  void connect(std::vector<Fifo<LineRequest>*> in, Fifo<LineRequest>& out, Fifo<LineReply>& replies,
               std::vector<LineClient*> clients) {
    in_ = std::move(in), out_ = &out, replies_ = &replies, clients_ = std::move(clients);
  }

 private:
  Did cycle() override {
    bool moved = false;
    if (replies_->valid()) {
      const LineReply& reply = *replies_->get();
      clients_[static_cast<std::size_t>(reply.client)]->arrived(reply, memory_.bytes.data() + reply.address);
      moved = true;
    }
    for (std::size_t i = 0; i < in_.size(); ++i) {
      Fifo<LineRequest>& in = *in_[(turn_ + i) % in_.size()];
      if (!in.valid()) continue;
      if (!out_->ready()) return moved ? Did::busy : Did::memory;
      *out_->put() = *in.get();
      turn_ = (turn_ + i + 1) % in_.size();
      return Did::busy;
    }
    return moved ? Did::busy : Did::starved;
  }

  const Memory& memory_;
  std::size_t turn_ = 0;
  std::vector<Fifo<LineRequest>*> in_;
  std::vector<LineClient*> clients_;
  Fifo<LineRequest>* out_ = nullptr;
  Fifo<LineReply>* replies_ = nullptr;
};

// A memory with a fixed latency and a bus of so many bytes a cycle. It takes a request a cycle, from one pipe
// after the other.
class MemoryBlock final : public LineMemory {
 public:
  MemoryBlock(Memory& memory, int latency, int bus_bytes)
      : memory_(memory), latency_(latency), bus_bytes_(bus_bytes) {}
  void connect(Fifo<LineRequest>& requests, Fifo<LineReply>& replies) override {
    ports_.push_back({&requests, &replies});
  }
  const MemoryCounts& counts() const override { return counts_; }
  void begin() override { bus_free_ = 0, turn_ = 0; }
  void share(Neighbour* neighbour) override { neighbour_ = neighbour; }
  bool cycle(std::int64_t now) override {
    bool moved = false;
    if (neighbour_ != nullptr) serve_neighbour(now);
    if (!under_way_.empty() && under_way_.front().done <= now &&
        ports_[under_way_.front().port].replies->ready()) {
      *ports_[under_way_.front().port].replies->put() = under_way_.front().reply;
      under_way_.pop_front();
      moved = true;
    }
    if (under_way_.size() >= kMostUnderWay) return moved;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      const std::size_t port = (turn_ + i) % ports_.size();
      if (!ports_[port].requests->valid()) continue;
      serve(*ports_[port].requests->get(), port, now);
      turn_ = (port + 1) % ports_.size();
      return true;
    }
    return moved;
  }

 private:
  static constexpr std::size_t kMostUnderWay = 256;
  static constexpr std::int64_t kMostAhead = 64;  // cycles of the bus that are promised
  struct Port {
    Fifo<LineRequest>* requests;
    Fifo<LineReply>* replies;
  };
  struct UnderWay {
    std::int64_t done;
    std::size_t port;
    LineReply reply;
  };

  // Its bytes fill whole cycles of the bus, one after the other.
  void serve_neighbour(std::int64_t now) {
    const std::int64_t first = now + latency_;
    owed_ += neighbour_->cycle(bus_free_ - first < kMostAhead);
    const std::int64_t beats = owed_ / bus_bytes_;
    if (beats == 0) return;
    owed_ %= bus_bytes_;
    bus_free_ = std::max(bus_free_, first) + beats;
  }
  void serve(const LineRequest& request, std::size_t port, std::int64_t now) {
    const std::int64_t beats = (request.bytes + bus_bytes_ - 1) / bus_bytes_;
    counts_.bus_cycles += beats;
    if (request.write) {
      std::memcpy(memory_.bytes.data() + request.address, request.data.data(),
                  static_cast<std::size_t>(request.bytes));
      counts_.written_bytes += request.bytes;
      bus_free_ = std::max(bus_free_, now + 1) + beats;
      return;
    }
    bus_free_ = std::max(bus_free_, now + latency_) + beats;
    ++counts_.reads;
    counts_.read_bytes += request.bytes;
    under_way_.push_back({bus_free_, port, {request.client, request.slot, request.address, request.bytes}});
  }

  Memory& memory_;
  int latency_, bus_bytes_;
  std::vector<Port> ports_;
  std::size_t turn_ = 0;
  std::int64_t bus_free_ = 0;
  Neighbour* neighbour_ = nullptr;
  std::int64_t owed_ = 0;  // bytes of the neighbour that fill no cycle yet
  std::deque<UnderWay> under_way_;
  MemoryCounts counts_;
};

}  // namespace voxmelt::hwmodel::raycast
