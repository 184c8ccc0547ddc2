// The memory port lies between a pipe and the memory. It sends the requests of several clients on one
// channel, and gives lines back to those who asked.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/stage.h"
#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel::raycast {

class MemoryPort final : public Stage {
 public:
  explicit MemoryPort(const Memory& memory) : Stage("memory port"), memory_(memory) {}
  void connect(std::vector<Fifo<LineRequest>*> in, Fifo<LineRequest>& out, Fifo<LineReply>& replies,
               std::vector<LineClient*> clients) {
    in_ = std::move(in);
    out_ = &out;
    replies_ = &replies;
    clients_ = std::move(clients);
  }

 private:
  Did cycle() override {
    bool moved = false;
    if (replies_->valid()) {
      const LineReply& reply = *replies_->get();
      clients_[reply.client]->arrived(reply, memory_.bytes.data() + reply.address);
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

}  // namespace voxmelt::hwmodel::raycast
