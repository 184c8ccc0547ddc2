#include "hwmodel/pipeline/check/feed_checker.h"

#include <string>
#include <utility>

namespace voxmelt::hwmodel {

FeedChecker::FeedChecker(StreamMachine& machine, Checker& checker)
    : machine_(machine), checker_(checker), shape_(machine.design().shape) {
  for (int t = 0; t < machine.configuration().cascade; ++t) feeds_.push_back({StageKind::feed, t});
}

void FeedChecker::begin_train(const Irradiance* field, std::optional<state::BitPlane> falling) {
  field_ = field;
  falling_ = std::move(falling);
  passes_.clear();
  for (Seen& feed : feeds_) feed.in_flight.clear();
  falls_.in_flight.clear();
}

template <class Value, class WantedOf>
void FeedChecker::compare_entered(Seen& feed, std::int64_t ordinal, const Value* lanes,
                                  const WantedOf& wanted_of) {
  const Place place = place_of_token(ordinal);
  for (int lane = 0; lane < shape_.lanes; ++lane) {
    feed.in_flight.push_back(lanes[lane]);
    const int x = place.x + lane;
    const std::int64_t wanted = x < shape_.grid.x ? wanted_of(x, place.y, place.z) : 0;
    if (lanes[lane] != wanted) report(Mismatch::Kind::stage, feed, ordinal, lane, wanted, lanes[lane]);
  }
}

template <class Value>
void FeedChecker::compare_left(Seen& feed, std::int64_t ordinal, const Value* lanes) {
  for (int lane = 0; lane < shape_.lanes; ++lane) {
    const std::int64_t entered = feed.in_flight.empty() ? 0 : feed.in_flight.front();
    if (!feed.in_flight.empty()) feed.in_flight.pop_front();
    if (lanes[lane] != entered) report(Mismatch::Kind::channel, feed, ordinal, lane, entered, lanes[lane]);
  }
}

void FeedChecker::entered(int channel, std::int64_t ordinal, const UInt<16>* lanes) {
  compare_entered(seen(channel), ordinal, lanes, [&](int x, int y, int z) -> std::int64_t {
    return (*field_)[field_->layout().at(x, y, z)];
  });
}

void FeedChecker::left(int channel, std::int64_t ordinal, const UInt<16>* lanes) {
  compare_left(seen(channel), ordinal, lanes);
}

void FeedChecker::entered(int channel, std::int64_t ordinal, const UInt<1>* lanes) {
  compare_entered(seen(channel), ordinal, lanes, [&](int x, int y, int z) -> std::int64_t {
    return falling_ && falling_->test(x, y, z) ? 1 : 0;
  });
}

void FeedChecker::left(int channel, std::int64_t ordinal, const UInt<1>* lanes) {
  compare_left(seen(channel), ordinal, lanes);
}

void FeedChecker::report(Mismatch::Kind kind, const Seen& feed, std::int64_t ordinal, int lane,
                         std::int64_t expected, std::int64_t actual) {
  if (checker_.mismatch() != nullptr) return;
  const bool of_pieces = feed.kind == StageKind::fall_feed;
  const Place place = place_of_token(ordinal);
  checker_.report({
      .kind = kind,
      .where = kind == Mismatch::Kind::channel
                   ? "step " + std::to_string(feed.cascade) + ": feed -> " + (of_pieces ? "fall" : "exchange")
                   : std::string(name_of(feed.kind)),
      .step = pass_of(ordinal).first + feed.cascade,
      .cascade = feed.cascade,
      .lane = lane,
      .cycle = machine_.cycle(),
      .x = place.x + lane,
      .y = place.y,
      .z = place.z,
      .field = of_pieces ? "falls" : "irradiance",
      .expected = expected,
      .actual = actual,
  });
}

}  // namespace voxmelt::hwmodel
