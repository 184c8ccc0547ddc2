// Tokens, tiles and lines get lost, come twice or come to somebody else.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>

#include "hwmodel/caster/faults/planted.h"
#include "hwmodel/caster/model/gather.h"
#include "hwmodel/caster/model/tile_stages.h"
#include "hwmodel/caster/model/token_id.h"

namespace voxmelt::hwmodel::raycast {

// Plants a fault in a channel between two stages.
template <class Word>
class TokenFault final : public FifoFault<Word> {
 public:
  TokenFault(FaultPlan& plan, const Fifo<Word>& channel) : plan_(plan), channel_(channel) {}

  using Effect = typename FifoFault<Word>::Effect;
  Effect stores(std::int64_t ordinal, Word* now, Word* last, int waiting) override {
    if (ordinal < 2) return Effect::none;
    const RayId here = id_of(*now), before = id_of(*last);
    if (plan_.armed(Fault::channel_lost)) {
      strike(here);
      return Effect::lost;
    }
    if (plan_.armed(Fault::channel_never_ready)) {
      strike(here);
      return Effect::jammed;
    }
    if constexpr (requires { now->normal.x; })
      if (plan_.armed(Fault::channel_bit)) {
        now->normal.x ^= 1;
        strike(here);
      }
    if (same_place(here, before)) return Effect::none;
    if (plan_.armed(Fault::channel_twice)) {
      *now = *last;
      strike(before);
    }
    if (plan_.armed(Fault::channel_swap) && waiting > 0) {
      std::swap(*now, *last);
      strike(before);
    }
    return Effect::none;
  }

 private:
  void strike(const RayId& at) { plan_.strike({channel_.name(), at.x, at.y, at.sample}); }

  FaultPlan& plan_;
  const Fifo<Word>& channel_;
};

// Plants a fault of the dealer. Its word leaves by a channel, so a change there changes what it deals.
class TileFault final : public FifoFault<TileJob> {
 public:
  explicit TileFault(FaultPlan& plan) : plan_(plan) {}
  Effect stores(std::int64_t ordinal, TileJob* now, TileJob* last, int) override {
    if (ordinal < 1) return Effect::none;
    if (plan_.armed(Fault::dealer_twice)) {
      *now = *last;
      plan_.strike({"dealer", now->x, now->y, 0});
    }
    if (plan_.armed(Fault::dealer_never)) {
      plan_.strike({"dealer", now->x, now->y, 0});
      return Effect::lost;
    }
    return Effect::none;
  }

 private:
  FaultPlan& plan_;
};

// Holds the last reply to any pipe.
struct LastReply {
  int pipe = -1;
  LineReply reply;
};
// Plants a fault on the way back from the memory, seen from one pipe.
class ReplyFault final : public FifoFault<LineReply> {
 public:
  ReplyFault(FaultPlan& plan, std::shared_ptr<LastReply> last, int pipe, int columns, int texels)
      : plan_(plan), last_(std::move(last)), pipe_(pipe), columns_(columns), texels_(texels) {}

  Effect stores(std::int64_t, LineReply* now, LineReply*, int) override {
    if (plan_.armed(Fault::memory_client) && now->client == columns_) {
      now->client = texels_;  // the cache of texels has as many slots
      strike(*now);
    }
    if (plan_.armed(Fault::memory_pipe)) {
      const LastReply before = std::exchange(*last_, {pipe_, *now});
      const bool other = before.reply.client != now->client || before.reply.slot != now->slot ||
                         before.reply.address != now->address;
      if (before.pipe < 0 || before.pipe == pipe_ || !other) return Effect::none;
      *now = before.reply;
      strike(*now);
    }
    return Effect::none;
  }

 private:
  void strike(const LineReply& reply) { plan_.strike({"memory", 0, 0, 0, reply.address}); }

  FaultPlan& plan_;
  std::shared_ptr<LastReply> last_;
  int pipe_, columns_, texels_;
};

class FlowFaults : public Planted {
 public:
  FlowFaults(FaultPlan& plan, const Registers& registers, const Memory& memory,
             std::shared_ptr<LastReply> last_reply)
      : Planted(plan, registers, memory), last_reply_(std::move(last_reply)) {}

  template <class Word>
  void made(Fifo<Word>& channel) {
    if constexpr (OfRay<Word> || OfTile<Word>) {
      if (channel.name() != plan().channel()) return;
      if (armed(Fault::channel_lost) || armed(Fault::channel_twice) || armed(Fault::channel_swap) ||
          armed(Fault::channel_bit) || armed(Fault::channel_never_ready))
        channel.plant(kept(std::make_shared<TokenFault<Word>>(plan(), channel)));
    }
  }
  void connected(int pipe, Fifo<TileJob>& tiles, Fifo<LineReply>& replies, int columns, int texels) {
    if (armed(Fault::dealer_twice) || armed(Fault::dealer_never))
      tiles.plant(kept(std::make_shared<TileFault>(plan())));
    if (armed(Fault::memory_client) || armed(Fault::memory_pipe))
      replies.plant(kept(std::make_shared<ReplyFault>(plan(), last_reply_, pipe, columns, texels)));
  }

  bool writes_early(bool at_once, const TileBuffer& tile) {
    if (!at_once || tile.left != 1 || !armed(Fault::write_early)) return false;
    strike("write", {tile.job.x, tile.job.y, 0, 0});
    return true;
  }

 private:
  template <class Made>
  Made* kept(std::shared_ptr<Made> made) {
    Made* result = made.get();
    plan().keep(std::move(made));
    return result;
  }

  std::shared_ptr<LastReply> last_reply_;
};

}  // namespace voxmelt::hwmodel::raycast
