// The checker watches what the feeds give. Every token must hold the irradiance of its cells, and leave its
// channel as it entered. The expected field is the software's, and not what lies in the memory of the
// machine.
#pragma once

#include <cstdint>
#include <deque>
#include <vector>

#include "hwmodel/pipeline/check/checker.h"

namespace voxmelt::hwmodel {

class FeedChecker final : public FifoWatcher<UInt<16>> {
 public:
  FeedChecker(StreamMachine& machine, Checker& checker);

  // `begin_train` is called before each train of passes, `add_pass` before each of its passes. `field` is
  // null without radiation.
  void begin_train(const Irradiance* field);
  void add_pass(const Pass& pass) { passes_.push_back(pass); }

  void entered(int channel, std::int64_t ordinal, const UInt<16>* lanes) override;
  void left(int channel, std::int64_t ordinal, const UInt<16>* lanes) override;

 private:
  struct Seen {  // tokens seen of one feed
    std::deque<std::int64_t> in_flight;
  };
  // Returns the pass of a token of the train.
  const Pass& pass_of(std::int64_t ordinal) const { return passes_[ordinal / shape_.tokens()]; }
  Place place_of_token(std::int64_t ordinal) const {
    return place_of(shape_, ordinal % shape_.tokens(), pass_of(ordinal).tile);
  }
  void report(Mismatch::Kind kind, int t, std::int64_t ordinal, int lane, std::int64_t expected,
              std::int64_t actual);

  StreamMachine& machine_;
  Checker& checker_;
  const Shape shape_;
  const Irradiance* field_ = nullptr;
  std::vector<Pass> passes_;  // passes of the train
  std::vector<Seen> feeds_;
};

}  // namespace voxmelt::hwmodel
