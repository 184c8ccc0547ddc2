#include "hwmodel/lockstep/checker.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
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
    Channel channel{report.name, report.producer, report.cascade, 0, false, {}, {}, {}};
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
    channel.expected = {};
    if (step >= expected.size() || expected[step].empty()) continue;
    channel.expected = expected[step].at(channel.stage);
    if (!channel.behind_stage)  // what is read is what was before the first stage
      channel.expected = Expected{channel.expected->before, channel.expected->before, {}};
  }
}

void Checker::entered(int number, std::int64_t /*ordinal*/, const Cell* lanes) {
  Channel& channel = channels_[static_cast<std::size_t>(number)];
  if (mismatch_ == nullptr && channel.expected) compare(channel, lanes);
  channel.in_flight.insert(channel.in_flight.end(), lanes, lanes + shape_.lanes);
  channel.place.next(shape_);
}

void Checker::compare(const Channel& channel, const Cell* lanes) {
  const Place& place = channel.place;
  const int cells = std::min(shape_.lanes, shape_.grid.x - place.x);
  for (int lane = 0; lane < cells; ++lane)
    if (!compare(channel, wanted_cell(*channel.expected, place.x + lane, place.y, place.z), lanes[lane],
                 lane))
      return;
  for (int lane = cells; lane < shape_.lanes; ++lane) {
    Cell border;
    border.beside_wall = lanes[lane].beside_wall;  // nobody asks which sides the border has
    if (!compare(channel, border, lanes[lane], lane)) return;
  }
  if (channel.behind_stage) compared_cells_ += cells;
}

bool Checker::compare(const Channel& channel, const Cell& wanted, const Cell& is, int lane) {
  const Place& place = channel.place;
  const auto same = [&](const char* field, std::int64_t a, std::int64_t b) {
    if (a == b) return true;
    report(channel, Mismatch::Kind::stage, place, lane, field, a, b);
    mismatch_->neighbourhood = neighbourhood(*channel.expected->before, place.x + lane, place.y, place.z);
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

void Checker::left(int number, std::int64_t ordinal, const Cell* lanes) {
  Channel& channel = channels_[static_cast<std::size_t>(number)];
  if (mismatch_ != nullptr) return;
  if (&channel == &channels_.back()) written_in_[static_cast<std::size_t>(ordinal)] = pipeline_.cycle();
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
