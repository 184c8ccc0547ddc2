#include <string>

#include "hwmodel/pipeline/check/feed_checker.h"

namespace voxmelt::hwmodel {

FeedChecker::FeedChecker(StreamMachine& machine, Checker& checker)
    : machine_(machine),
      checker_(checker),
      shape_(machine.design().shape),
      feeds_(machine.configuration().cascade) {}

void FeedChecker::begin_train(const Irradiance* field) {
  field_ = field;
  passes_.clear();
  for (Seen& feed : feeds_) feed.in_flight.clear();
}

void FeedChecker::entered(int channel, std::int64_t ordinal, const UInt<16>* lanes) {
  const int t = channel - StreamMachine::kFirstFeedChannel;
  Seen& feed = feeds_[t];
  const Place place = place_of_token(ordinal);
  for (int lane = 0; lane < shape_.lanes; ++lane) {
    feed.in_flight.push_back(lanes[lane]);
    const int x = place.x + lane;
    const std::int64_t wanted = x < shape_.grid.x ? (*field_)[field_->layout().at(x, place.y, place.z)] : 0;
    if (lanes[lane] != wanted) report(Mismatch::Kind::stage, t, ordinal, lane, wanted, lanes[lane]);
  }
}

void FeedChecker::left(int channel, std::int64_t ordinal, const UInt<16>* lanes) {
  const int t = channel - StreamMachine::kFirstFeedChannel;
  Seen& feed = feeds_[t];
  for (int lane = 0; lane < shape_.lanes; ++lane) {
    const std::int64_t entered = feed.in_flight.empty() ? 0 : feed.in_flight.front();
    if (!feed.in_flight.empty()) feed.in_flight.pop_front();
    if (lanes[lane] != entered) report(Mismatch::Kind::channel, t, ordinal, lane, entered, lanes[lane]);
  }
}

void FeedChecker::report(Mismatch::Kind kind, int t, std::int64_t ordinal, int lane, std::int64_t expected,
                         std::int64_t actual) {
  if (checker_.mismatch() != nullptr) return;
  const Place place = place_of_token(ordinal);
  checker_.report({
      .kind = kind,
      .where = kind == Mismatch::Kind::channel ? "step " + std::to_string(t) + ": feed -> exchange"
                                               : std::string(name_of(StageKind::feed)),
      .step = pass_of(ordinal).first + t,
      .cascade = t,
      .lane = lane,
      .cycle = machine_.cycle(),
      .x = place.x + lane,
      .y = place.y,
      .z = place.z,
      .field = "irradiance",
      .expected = expected,
      .actual = actual,
  });
}

}  // namespace voxmelt::hwmodel
