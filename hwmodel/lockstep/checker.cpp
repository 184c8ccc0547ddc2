#include "hwmodel/lockstep/checker.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "hwmodel/stream/volume_port.h"

namespace voxmelt::hwmodel {

Checker::Checker(Pipeline& pipeline)
    : pipeline_(pipeline), shape_(pipeline.design().shape), wanted_(static_cast<std::size_t>(shape_.lanes)) {
  int cascade = -1;
  std::size_t stage = 0;
  for (const ChannelReport& report : pipeline.channels()) {
    if (report.producer == StageKind::feed) continue;
    Channel channel{report.name, report.producer, report.cascade, 0, false, nullptr, {}, {}};
    if (report.producer != StageKind::reader) {
      stage = report.cascade == cascade ? stage + 1 : 0;
      cascade = report.cascade;
      channel.stage = stage;
      channel.behind_stage = true;
    }
    channels_.push_back(std::move(channel));
  }
}

void Checker::begin_pass(std::uint32_t first_step, const std::vector<std::vector<Expected>>& expected) {
  first_step_ = first_step;
  for (Channel& channel : channels_) {
    channel.place = {};
    channel.in_flight.clear();
    const auto step = static_cast<std::size_t>(channel.cascade);
    const bool compared = channel.behind_stage && step < expected.size() && !expected[step].empty();
    channel.expected = compared ? &expected[step].at(channel.stage) : nullptr;
  }
}

void Checker::entered(int number, std::int64_t /*ordinal*/, const Cell* lanes) {
  Channel& channel = channels_[static_cast<std::size_t>(number)];
  if (mismatch_ == nullptr && channel.expected != nullptr) compare(channel, lanes);
  channel.in_flight.insert(channel.in_flight.end(), lanes, lanes + shape_.lanes);
  channel.place.next(shape_);
}

void Checker::compare(Channel& channel, const Cell* lanes) {
  const Expected& expected = *channel.expected;
  const Place& place = channel.place;
  read_token(*expected.after, shape_, place, wanted_.data());
  const int cells = std::min(shape_.lanes, shape_.grid.x - place.x);
  for (int lane = 0; lane < cells; ++lane) {
    const Cell& want = wanted_[static_cast<std::size_t>(lane)];
    const Cell& is = lanes[lane];
    const auto differs = [&](const char* field, std::int64_t a, std::int64_t b) {
      if (a == b || mismatch_ != nullptr) return;
      report(channel, Mismatch::Kind::stage, place, lane, field, a, b);
      mismatch_->neighbourhood = neighbourhood(*expected.before, place.x + lane, place.y, place.z);
    };
    differs("state", static_cast<int>(want.state), static_cast<int>(is.state));
    differs("amount", want.amount, is.amount);
    differs("energy", want.energy, is.energy);
    differs("heat", want.heat, is.heat);
    if (expected.pattern != nullptr)
      differs("pattern", (*expected.pattern)[expected.after->at(place.x + lane, place.y, place.z)],
              is.pattern);
    if (mismatch_ != nullptr) return;
  }
  compared_cells_ += cells;
}

void Checker::left(int number, std::int64_t ordinal, const Cell* lanes) {
  Channel& channel = channels_[static_cast<std::size_t>(number)];
  if (mismatch_ != nullptr) return;
  for (int lane = 0; lane < shape_.lanes; ++lane) {
    const Cell entered = channel.in_flight.empty() ? Cell{} : channel.in_flight.front();
    if (!channel.in_flight.empty()) channel.in_flight.pop_front();
    const Cell& is = lanes[lane];
    if (entered == is) continue;
    const Place place = place_of(shape_, ordinal);
    const auto differs = [&](const char* field, std::int64_t a, std::int64_t b) {
      if (a != b && mismatch_ == nullptr) report(channel, Mismatch::Kind::channel, place, lane, field, a, b);
    };
    differs("state", static_cast<int>(entered.state), static_cast<int>(is.state));
    differs("amount", entered.amount, is.amount);
    differs("energy", entered.energy, is.energy);
    differs("heat", entered.heat, is.heat);
    differs("side band", 0, 1);
    return;
  }
}

void Checker::report(const Channel& channel, Mismatch::Kind kind, const Place& place, int lane,
                     const char* field, std::int64_t expected, std::int64_t actual) {
  const bool in_channel = kind == Mismatch::Kind::channel;
  mismatch_ = std::make_unique<Mismatch>(Mismatch{
      .kind = kind,
      .where = in_channel ? channel.name : std::string(name_of(channel.producer)),
      .phase = phase_of(channel.producer),
      .step = first_step_ + static_cast<std::uint32_t>(channel.cascade),
      .cascade = channel.cascade,
      .lane = lane,
      .cycle = pipeline_.cycle(),
      .x = place.x + lane,
      .y = place.y,
      .z = place.z,
      .field = field,
      .expected = expected,
      .actual = actual,
  });
  pipeline_.stop();
}

}  // namespace voxmelt::hwmodel
