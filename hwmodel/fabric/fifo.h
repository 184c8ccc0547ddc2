// A channel is a bounded ready/valid stream of tokens (P lanes each). Both sides decide on the state at the
// begin of a cycle, and `commit` ends the cycle. So the order in which blocks are evaluated cannot matter. A
// channel of depth 1 moves a token every second cycle, one of depth 2 or more every cycle.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/fabric/stall.h"

namespace voxmelt::hwmodel {

// Sees what enters and leaves a channel. Ordinals count the tokens of a pass from 0.
template <class Word>
class FifoWatcher {
 public:
  virtual ~FifoWatcher() = default;
  virtual void entered(int channel, std::int64_t ordinal, const Word* lanes) = 0;
  virtual void left(int channel, std::int64_t ordinal, const Word* lanes) = 0;
};

// Sees both sides of a channel in every cycle, whatever its tokens are.
class ChannelProbe {
 public:
  struct Sides {
    bool ready, put;  // the producer may put a token; it does
    bool valid, get;  // the consumer may take one; it does
    int count;        // tokens at the begin of the cycle
  };
  virtual ~ChannelProbe() = default;
  // `in` is the token that enters, `out` the oldest one. Each points to the lanes of a token, and is null if
  // there is none.
  virtual void cycle(int channel, const Sides& sides, const void* in, const void* out) = 0;
};

// Corrupts what is stored. `last` is the token stored before `now`. `waiting` counts the tokens in front of
// it.
template <class Word>
class FifoFault {
 public:
  // A `lost` token is not stored. A `jammed` channel takes no more tokens after `now`.
  enum class Effect : std::uint8_t { none, lost, jammed };
  virtual ~FifoFault() = default;
  virtual Effect stores(std::int64_t ordinal, Word* now, Word* last, int waiting) = 0;
};

template <class Word>
class Fifo {
 public:
  Fifo(std::string name, int channel, int lanes, int depth, std::uint64_t stall_seed)
      : name_(std::move(name)),
        channel_(channel),
        lanes_(lanes),
        depth_(depth),
        words_(lanes_ * depth),
        occupancy_(depth + 1),
        stall_seed_(stall_seed) {
    begin_pass(0);
  }

  const std::string& name() const { return name_; }
  int channel() const { return channel_; }
  int depth() const { return depth_; }

  // The producer's side follows. `put` gives the place of the new token, which must be filled before
  // `commit`.
  bool ready() const { return count_ < depth_ && !stall_.put && !jammed_; }
  Word* put() {
    putting_ = true;
    return slot(tail_);
  }

  // The consumer's side follows. The oldest token stays valid until `commit`.
  bool valid() const { return count_ > 0 && !stall_.get; }
  const Word* get() {
    getting_ = true;
    return slot(head_);
  }

  // Ends the cycle.
  void commit() {
    if (probe_ != nullptr) [[unlikely]]
      probe_->cycle(channel_, {ready(), putting_, valid(), getting_, count_},
                    putting_ ? slot(tail_) : nullptr, count_ > 0 ? slot(head_) : nullptr);
    if (putting_ || getting_) {
      if (putting_) end_put();
      if (getting_) end_get();
      putting_ = getting_ = false;
      highest_ = std::max(highest_, count_);
    }
    // A channel that holds too many has overwritten its oldest token. A watcher notices it when that token
    // leaves.
    ++occupancy_[std::min(count_, depth_)];
    stall_ = stalls_.next();
  }

  void begin_pass(std::uint64_t pass) {
    entered_ = left_ = 0;
    stall_ = {};
    stalls_ = StallInjector(stall_seed_, channel_, pass);
  }
  void watch(FifoWatcher<Word>* watcher) { watcher_ = watcher; }
  void probe(ChannelProbe* probe) { probe_ = probe; }  // null: no probe

  void plant(FifoFault<Word>* fault) { fault_ = fault; }  // null: no fault

  int count() const { return count_; }
  int highest() const { return highest_; }  // highest occupancy since the begin
  const std::vector<std::int64_t>& occupancy() const { return occupancy_; }  // cycles with 0, 1, ... tokens
  std::int64_t entered() const { return entered_; }
  std::int64_t left() const { return left_; }
  const Word* oldest() const { return words_.data() + head_ * lanes_; }

 private:
  Word* slot(std::size_t at) { return words_.data() + at * lanes_; }
  std::size_t after(std::size_t at) const { return at + 1 == static_cast<std::size_t>(depth_) ? 0 : at + 1; }
  std::size_t before(std::size_t at) const { return (at == 0 ? depth_ : at) - 1; }

  void end_put() {
    if (watcher_ != nullptr) watcher_->entered(channel_, entered_, slot(tail_));
    using Effect = typename FifoFault<Word>::Effect;
    Effect effect = Effect::none;
    if (fault_ != nullptr) [[unlikely]]
      effect = fault_->stores(entered_, slot(tail_), slot(before(tail_)), count_ - (getting_ ? 1 : 0));
    ++entered_;
    if (effect == Effect::lost) return;
    jammed_ |= effect == Effect::jammed;
    ++count_;
    tail_ = after(tail_);
  }
  void end_get() {
    if (watcher_ != nullptr) watcher_->left(channel_, left_, slot(head_));
    ++left_;
    --count_;
    head_ = after(head_);
  }

  std::string name_;
  int channel_;
  std::size_t lanes_;
  int depth_, count_ = 0, highest_ = 0;
  std::size_t head_ = 0, tail_ = 0;
  bool putting_ = false, getting_ = false;
  std::vector<Word> words_;
  std::vector<std::int64_t> occupancy_;
  std::uint64_t stall_seed_;
  StallInjector stalls_;
  StallInjector::Stall stall_;
  std::int64_t entered_ = 0, left_ = 0;
  FifoWatcher<Word>* watcher_ = nullptr;
  ChannelProbe* probe_ = nullptr;
  FifoFault<Word>* fault_ = nullptr;
  bool jammed_ = false;
};

}  // namespace voxmelt::hwmodel
