// The checker watches what the feeds give. Every token must hold the irradiance of its cells, or tell which
// of them fall, and leave its channel as it entered. The expected values are the software's, and not what
// lies in the memory of the machine.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "hwmodel/pipeline/check/checker.h"
#include "kernel/automaton/state/bit_plane.h"

namespace voxmelt::hwmodel {

class FeedChecker final : public FifoWatcher<UInt<16>>, public FifoWatcher<UInt<1>> {
 public:
  FeedChecker(StreamMachine& machine, Checker& checker);

  // `begin_train` is called before each train of passes, `add_pass` before each of its passes. `field` is
  // null without radiation. `falling` is empty if no cell falls.
  void begin_train(const Irradiance* field, std::optional<state::BitPlane> falling);
  void add_pass(const Pass& pass) { passes_.push_back(pass); }

  void entered(int channel, std::int64_t ordinal, const UInt<16>* lanes) override;
  void left(int channel, std::int64_t ordinal, const UInt<16>* lanes) override;
  void entered(int channel, std::int64_t ordinal, const UInt<1>* lanes) override;
  void left(int channel, std::int64_t ordinal, const UInt<1>* lanes) override;

 private:
  // Describes a feed, and holds the tokens that are in its channel.
  struct Seen {
    StageKind kind = StageKind::feed;
    int cascade = 0;
    std::deque<std::int64_t> in_flight{};
  };
  Seen& seen(int channel) {
    return channel == StreamMachine::kFallChannel ? falls_
                                                  : feeds_[channel - StreamMachine::kFirstFeedChannel];
  }
  template <class Value, class WantedOf>  // wanted_of(x, y, z) of a cell in the grid
  void compare_entered(Seen& feed, std::int64_t ordinal, const Value* lanes, const WantedOf& wanted_of);
  template <class Value>
  void compare_left(Seen& feed, std::int64_t ordinal, const Value* lanes);
  // Returns the pass of a token of the train.
  const Pass& pass_of(std::int64_t ordinal) const { return passes_[ordinal / shape_.tokens()]; }
  Place place_of_token(std::int64_t ordinal) const {
    return place_of(shape_, ordinal % shape_.tokens(), pass_of(ordinal).tile);
  }
  void report(Mismatch::Kind kind, const Seen& feed, std::int64_t ordinal, int lane, std::int64_t expected,
              std::int64_t actual);

  StreamMachine& machine_;
  Checker& checker_;
  const Shape shape_;
  const Irradiance* field_ = nullptr;
  std::optional<state::BitPlane> falling_;
  std::vector<Pass> passes_;  // passes of the train
  std::vector<Seen> feeds_;   // those of irradiance
  Seen falls_{StageKind::fall_feed};
};

}  // namespace voxmelt::hwmodel
