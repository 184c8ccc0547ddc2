#include "hwmodel/lockstep/checker.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "hwmodel/lockstep/wanted_cell.h"

namespace voxmelt::hwmodel {

Checker::Checker(Pipeline& pipeline)
    : pipeline_(pipeline),
      shape_(pipeline.design().shape),
      written_in_(static_cast<std::size_t>(shape_.tokens())) {
  int cascade = -1;
  std::size_t stage = 0;
  for (const ChannelReport& report : pipeline.channels()) {
    if (report.producer == StageKind::feed) continue;
    Channel channel{report.name, report.producer, report.cascade, 0, false, 0, 0, {}, {}, {}};
    if (report.producer != StageKind::reader) {
      stage = report.cascade == cascade ? stage + 1 : 0;
      cascade = report.cascade;
      channel.stage = stage;
      channel.behind_stage = true;
    }
    channels_.push_back(std::move(channel));
  }
}

void Checker::begin_train() {
  passes_.clear();
  written_ = 0;
  for (Channel& channel : channels_) {
    channel.entering = channel.leaving = 0;
    channel.place = channel.left = {};
    channel.in_flight.clear();
  }
}

void Checker::add_pass(Wanted wanted) { passes_.push_back(std::move(wanted)); }

const Expected* Checker::expected_of(const Channel& channel) {
  const auto& steps = passes_[channel.entering - written_].steps;
  const auto step = static_cast<std::size_t>(channel.cascade);
  if (step >= steps.size() || steps[step].empty()) return nullptr;
  const Expected& expected = steps[step].at(channel.stage);
  if (channel.behind_stage) return &expected;
  read_ = {expected.before, expected.before, {}};  // before the first stage
  return &read_;
}

void Checker::entered(int number, std::int64_t /*ordinal*/, const Cell* lanes) {
  Channel& channel = channels_[static_cast<std::size_t>(number)];
  if (mismatch_ == nullptr) compare(channel, lanes);
  channel.in_flight.insert(channel.in_flight.end(), lanes, lanes + shape_.lanes);
  channel.place.next(shape_);
  if (channel.place.ordinal == shape_.tokens()) ++channel.entering, channel.place = {};
}

void Checker::compare(const Channel& channel, const Cell* lanes) {
  const Expected* expected = expected_of(channel);
  if (expected == nullptr) return;
  const Place& place = channel.place;
  const int cells = std::min(shape_.lanes, shape_.grid.x - place.x);
  for (int lane = 0; lane < cells; ++lane) {
    const Cell wanted = wanted_cell(*expected, place.x + lane, place.y, place.z);
    if (!compare(channel, *expected, wanted, lanes[lane], lane)) return;
  }
  for (int lane = cells; lane < shape_.lanes; ++lane) {
    Cell border;
    border.beside_wall = lanes[lane].beside_wall;  // nobody asks which sides the border has
    if (!compare(channel, *expected, border, lanes[lane], lane)) return;
  }
  if (channel.behind_stage) compared_cells_ += cells;
}

bool Checker::compare(const Channel& channel, const Expected& expected, const Cell& wanted, const Cell& is,
                      int lane) {
  const Place& place = channel.place;
  const auto same = [&](const char* field, std::int64_t a, std::int64_t b) {
    if (a == b) return true;
    report(channel, Mismatch::Kind::stage, channel.entering, place, lane, field, a, b);
    mismatch_->neighbourhood = neighbourhood(*expected.before, place.x + lane, place.y, place.z);
    return false;
  };
  return same("state", static_cast<int>(wanted.state), static_cast<int>(is.state)) &&
         same("amount", wanted.amount, is.amount) && same("energy", wanted.energy, is.energy) &&
         same("heat", wanted.heat, is.heat) && same("pattern", wanted.pattern, is.pattern) &&
         same("exposed axes", wanted.exposed_axes, is.exposed_axes) &&
         same("beside a wall", wanted.beside_wall, is.beside_wall) &&
         same("in a run", wanted.in_run, is.in_run) && same("head", wanted.head, is.head) &&
         same("limit", wanted.limit, is.limit) && same("mobility", wanted.mobility, usable_mobility(is)) &&
         same("dead zone", wanted.dead, is.dead);
}

void Checker::left(int number, std::int64_t /*ordinal*/, const Cell* lanes) {
  Channel& channel = channels_[static_cast<std::size_t>(number)];
  if (mismatch_ != nullptr) return;
  const bool writes = &channel == &channels_.back();
  if (writes) written_in_[static_cast<std::size_t>(channel.left.ordinal)] = pipeline_.cycle();
  for (int lane = 0; lane < shape_.lanes; ++lane) {
    const Cell entered = channel.in_flight.empty() ? Cell{} : channel.in_flight.front();
    if (!channel.in_flight.empty()) channel.in_flight.pop_front();
    const Cell& is = lanes[lane];
    if (entered == is) continue;
    const auto differs = [&](const char* field, std::int64_t a, std::int64_t b) {
      if (a != b && mismatch_ == nullptr)
        report(channel, Mismatch::Kind::channel, channel.leaving, channel.left, lane, field, a, b);
    };
    differs("state", static_cast<int>(entered.state), static_cast<int>(is.state));
    differs("amount", entered.amount, is.amount);
    differs("energy", entered.energy, is.energy);
    differs("heat", entered.heat, is.heat);
    differs("side band", 0, 1);
    return;
  }
  if (writes) compare_written(channel, lanes);
  channel.left.next(shape_);
  if (channel.left.ordinal < shape_.tokens()) return;
  ++channel.leaving, channel.left = {};
  if (!writes) return;
  passes_.pop_front();
  ++written_;
}

void Checker::compare_written(const Channel& channel, const Cell* lanes) {
  const std::shared_ptr<const state::Volume>& written = passes_[channel.leaving - written_].written;
  if (written == nullptr) return;
  const Place& place = channel.left;
  const Expected expected{written, written, {}};
  const int cells = std::min(shape_.lanes, shape_.grid.x - place.x);
  for (int lane = 0; lane < cells && mismatch_ == nullptr; ++lane) {
    const Cell wanted = wanted_cell(expected, place.x + lane, place.y, place.z);
    const auto differs = [&](const char* field, std::int64_t a, std::int64_t b) {
      if (a != b && mismatch_ == nullptr)
        report(channel, Mismatch::Kind::memory, channel.leaving, place, lane, field, a, b);
    };
    differs("state", static_cast<int>(wanted.state), static_cast<int>(lanes[lane].state));
    differs("amount", wanted.amount, lanes[lane].amount);
    differs("energy", wanted.energy, lanes[lane].energy);
    differs("heat", wanted.heat, lanes[lane].heat);
  }
}

void Checker::report(const Channel& channel, Mismatch::Kind kind, std::size_t pass, const Place& place,
                     int lane, const char* field, std::int64_t expected, std::int64_t actual) {
  const Wanted& wanted = passes_[pass - written_];
  const bool written = kind == Mismatch::Kind::memory, in_channel = kind == Mismatch::Kind::channel;
  mismatch_ = std::make_unique<Mismatch>(Mismatch{
      .kind = kind,
      .where =
          in_channel ? channel.name : std::string(name_of(written ? StageKind::writer : channel.producer)),
      .phase = written ? std::nullopt : phase_of(channel.producer),
      .step = wanted.first_step + (written ? static_cast<std::uint32_t>(wanted.steps.size()) - 1
                                           : static_cast<std::uint32_t>(channel.cascade)),
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
  if (stops_) pipeline_.stop();
}

}  // namespace voxmelt::hwmodel
