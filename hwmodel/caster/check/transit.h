// A token that enters a channel must leave it: once, in order, unchanged. Behind each stage the checker
// compares what enters a channel. Transit compares what leaves it with that.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/caster/check/difference.h"
#include "hwmodel/caster/model/pipe.h"
#include "hwmodel/caster/model/ray_caster.h"
#include "hwmodel/caster/model/token_id.h"

namespace voxmelt::hwmodel::raycast {

class Transit {
 public:
  using Tell = std::function<void(Difference)>;
  // The caster must outlive this object.
  Transit(const RayCaster& caster, Tell tell);

  // Wraps the watchers of all channels that are watched. These watchers must outlive this object.
  Watchers around(Watchers watchers);
  void begin_pass() { under_way_.assign(under_way_.size(), {}); }
  // Looks for a lost token after a hang: it entered a channel, and the channel knows nothing of it.
  void look_for_lost();
  std::int64_t compared() const { return compared_; }  // compared tokens

 private:
  struct Token {
    RayId id;
    std::uint64_t sum = 0;
  };
  struct Line {
    std::deque<Token> tokens;
    Token last;  // the last one that left
    bool any_left = false;
  };

  template <class Word>
  class Around final : public FifoWatcher<Word> {
   public:
    Around(Transit& transit, FifoWatcher<Word>& inner) : transit_(transit), inner_(inner) {}
    void entered(int channel, std::int64_t ordinal, const Word* token) override {
      transit_.line(channel).tokens.push_back({id_of(*token), sum_of(*token)});
      inner_.entered(channel, ordinal, token);
    }
    void left(int channel, std::int64_t ordinal, const Word* token) override {
      transit_.left(channel, {id_of(*token), sum_of(*token)});
      inner_.left(channel, ordinal, token);
    }

   private:
    Transit& transit_;
    FifoWatcher<Word>& inner_;
  };
  template <class Word>
  FifoWatcher<Word>* around(FifoWatcher<Word>* inner) {
    if (inner == nullptr) return nullptr;
    auto made = std::make_shared<Around<Word>>(*this, *inner);
    FifoWatcher<Word>* watcher = made.get();
    owned_.push_back(std::move(made));
    return watcher;
  }
  // A token stays where it is in its channel, and with it every byte between its members. Each of four sums
  // takes every fourth word, so that they do not wait for one another.
  template <class Word>
  static std::uint64_t sum_of(const Word& token) {
    constexpr std::uint64_t kFactor = 0xBF58476D1CE4E5B9U;
    std::array<std::uint64_t, 4> sums{0x9E3779B97F4A7C15U, 2, 3, 4};
    const auto* at = reinterpret_cast<const unsigned char*>(&token);
    const auto add = [&](std::uint64_t& sum, std::size_t bytes) {
      std::uint64_t word = 0;
      std::memcpy(&word, at, bytes);
      sum = (sum ^ word) * kFactor;
      sum ^= sum >> 29;
      at += bytes;
    };
    for (std::size_t i = 0; i < sizeof token / 32; ++i)
      for (std::uint64_t& sum : sums) add(sum, 8);
    for (std::size_t i = 0; i < sizeof token % 32 / 8; ++i) add(sums[i], 8);
    add(sums[3], sizeof token % 8);
    std::uint64_t all = 0;
    for (const std::uint64_t sum : sums) {
      all = (all ^ sum) * kFactor;
      all ^= all >> 29;
    }
    return all;
  }

  Line& line(int channel);
  void left(int channel, const Token& token);
  void tell(int channel, const RayId& at, const char* name, std::string expected, std::string actual);
  std::string name_of(int channel) const;

  const RayCaster& caster_;
  Tell tell_;
  std::vector<Line> under_way_;  // indexed by channel
  std::vector<std::shared_ptr<void>> owned_;
  std::int64_t compared_ = 0;
};

}  // namespace voxmelt::hwmodel::raycast
