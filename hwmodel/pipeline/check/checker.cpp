#include "hwmodel/pipeline/check/checker.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hwmodel/pipeline/check/wanted_cell.h"
#include "hwmodel/pipeline/model/cell_wires.h"
#include "hwmodel/pipeline/model/lag.h"

namespace voxmelt::hwmodel {
namespace {

constexpr Cell kEmptyCell = [] {
  Cell cell;
  cell.amount = 0;
  cell.state = State::air;
  return cell;
}();

}  // namespace

Checker::Checker(StreamMachine& machine)
    : machine_(machine),
      shape_(machine.design().shape),
      stages_(stages_of_step(machine.design())),
      written_in_(shape_.tokens() * shape_.tiles()) {
  int cascade = -1;
  std::size_t stage = 0;
  for (const ChannelReport& report : machine.channels()) {
    if (is_feed(report.producer)) continue;
    Channel channel{report.name,
                    report.producer,
                    report.cascade,
                    0,
                    false,
                    0,
                    0,
                    {},
                    {},
                    SIZE_MAX,
                    {},
                    nullptr,
                    {},
                    {},
                    Ring<Cell>(shape_.lanes)};
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
    channel.spanned = SIZE_MAX;
    channel.place = channel.left = {};
    channel.in_flight.clear();
  }
}

void Checker::add_pass(Wanted wanted) {
  if (written_ == 0 && passes_.empty())
    for (Channel& channel : channels_) channel.place = channel.left = begin_of(shape_, wanted.pass.tile);
  passes_.push_back(std::move(wanted));
}

Checker::Span Checker::span_of(const Channel& channel, const Pass& pass) const {
  // `step` sums what all stages of a time step spoil, `before` what those up to the producer spoil.
  int copy = -1, step = 0, before = 0;
  for (std::size_t i = 0; i < stages_.size(); ++i) {
    if (stages_[i] == StageKind::settle) ++copy;
    if (pass.uses(stages_[i], copy)) step += lag_of(stages_[i], machine_.design()).reach;
    if (channel.behind_stage && i == channel.stage) before = step;
  }
  const int spoilt = channel.cascade * step + before;
  const int left = shape_.first_block(pass.tile) * shape_.lanes, end = left + shape_.blocks() * shape_.lanes;
  const int own = shape_.owned_begin(pass.tile) * shape_.lanes,
            own_end = shape_.owned_end(pass.tile) * shape_.lanes;
  return {left == 0 ? 0 : std::min(left + spoilt, own),
          end >= shape_.grid.x ? shape_.grid.x : std::max(end - spoilt, own_end)};
}

void Checker::next_pass(std::size_t& pass, Place& place) const {
  ++pass;
  const std::size_t at = pass - written_;
  if (at < passes_.size()) place = begin_of(shape_, passes_[at].pass.tile);
}

const Expected* Checker::expected_of(Channel& channel) const {
  const auto& steps = passes_[channel.entering - written_].steps;
  const std::size_t step = channel.cascade;
  if (step >= steps.size() || steps[step].empty()) return nullptr;
  const Expected& expected = steps[step].at(channel.stage);
  if (channel.behind_stage) return &expected;
  channel.read = {expected.before, expected.before, {}};  // before the first stage
  // Memory keeps what is set for the later passes of a step. Their first stage hands it on.
  if (!passes_[channel.entering - written_].pass.begins()) channel.read.bands.set = expected.bands.set;
  return &channel.read;
}

void Checker::entered(int number, std::int64_t /*ordinal*/, const Cell* lanes) {
  Channel& channel = channels_[number];
  if (channel.spanned != channel.entering) {
    channel.spanned = channel.entering;
    channel.span = span_of(channel, passes_[channel.entering - written_].pass);
    channel.expected = expected_of(channel);
    channel.air.forget();
  }
  if (mismatch_ == nullptr && channel.expected != nullptr) compare(channel, lanes);
  channel.in_flight.push(lanes);
  channel.place.next(shape_);
  if (channel.place.ordinal == shape_.tokens()) next_pass(channel.entering, channel.place);
}

// A token of nothing but air, as most are, needs no look at its cells one by one.
bool Checker::equals_air(Channel& channel, const Cell* lanes) const {
  const Place& place = channel.place;
  return place.x >= channel.span.begin && place.x + shape_.lanes <= channel.span.end &&
         std::all_of(lanes, lanes + shape_.lanes, [](const Cell& is) { return is == kEmptyCell; }) &&
         channel.air.at(*channel.expected, shape_, place);
}

void Checker::compare(Channel& channel, const Cell* lanes) {
  const Expected& expected = *channel.expected;
  const Place& place = channel.place;
  const Pass& pass = passes_[channel.entering - written_].pass;
  const int cells = std::min(shape_.lanes, shape_.grid.x - place.x);
  if (equals_air(channel, lanes)) {
    if (channel.behind_stage && shape_.owns(pass.tile, place.x)) compared_cells_ += cells;
    return;
  }
  for (int lane = 0; lane < cells; ++lane) {
    const int x = place.x + lane;
    if (x < channel.span.begin || x >= channel.span.end) continue;
    const Cell wanted = wanted_cell(expected, x, place.y, place.z);
    if (!compare(channel, expected, wanted, lanes[lane], lane)) return;
    if (channel.behind_stage && shape_.owns(pass.tile, x)) ++compared_cells_;
  }
  for (int lane = cells; lane < shape_.lanes; ++lane) {
    Cell border;
    border.beside_wall = lanes[lane].beside_wall;  // no stage reads which sides the border has
    border.touches = lanes[lane].touches;
    if (!compare(channel, expected, border, lanes[lane], lane)) return;
  }
}

bool Checker::compare(const Channel& channel, const Expected& expected, const Cell& wanted, const Cell& is,
                      int lane) {
  if (wanted == is) return true;
  const Place& place = channel.place;
  const auto same = [&](std::string_view field, std::int64_t a, std::int64_t b) {
    if (a == b) return true;
    report(channel, Mismatch::Kind::stage, channel.entering, place, lane, field, a, b);
    mismatch_->neighbourhood = neighbourhood(*expected.before, place.x + lane, place.y, place.z);
    return false;
  };
  return std::all_of(kCellWires.begin(), kCellWires.end(), [&](const CellWire& row) {
    const std::int64_t actual = row.wire == Wire::mobility ? usable_mobility(is) : row.get(is);
    return same(row.label, row.get(wanted), actual);
  });
}

// Returns false if the token that leaves is not the one that entered.
bool Checker::compare_with_entered(Channel& channel, const Cell* lanes) {
  static const std::vector<Cell> nothing(kMostLanes);
  const Cell* const entered = channel.in_flight.empty() ? nothing.data() : channel.in_flight.pop();
  const int lane = static_cast<int>(std::mismatch(lanes, lanes + shape_.lanes, entered).first - lanes);
  if (lane == shape_.lanes) return true;
  for (const CellWire& row : kCellWires) {
    const std::int64_t was = row.get(entered[lane]), is = row.get(lanes[lane]);
    if (was != is && mismatch_ == nullptr)
      report(channel, Mismatch::Kind::channel, channel.leaving, channel.left, lane, row.label, was, is);
  }
  return false;
}

void Checker::left(int number, std::int64_t /*ordinal*/, const Cell* lanes) {
  Channel& channel = channels_[number];
  if (mismatch_ != nullptr) return;
  const bool writes = &channel == &channels_.back();
  if (writes) {
    const std::int64_t streamed = passes_[channel.leaving - written_].pass.tile * shape_.tokens();
    written_in_[streamed + channel.left.ordinal] = machine_.cycle();
  }
  if (!compare_with_entered(channel, lanes)) return;
  if (writes) compare_written(channel, lanes);
  if (writes && channel.left.ordinal + 1 == shape_.tokens()) compare_pass(channel);
  channel.left.next(shape_);
  if (channel.left.ordinal < shape_.tokens()) return;
  next_pass(channel.leaving, channel.left);
  if (!writes) return;
  passes_.pop_front();
  ++written_;
}

void Checker::compare_written(const Channel& channel, const Cell* lanes) {
  const Wanted& wanted = passes_[channel.leaving - written_];
  const Place& place = channel.left;
  const int cells = std::min(shape_.lanes, shape_.grid.x - place.x);
  if (wanted.written != nullptr && shape_.owns(wanted.pass.tile, place.x))
    for (int lane = 0; lane < cells; ++lane) compare_memory(channel, *wanted.written, lane, lanes[lane]);
  // Every written cell must have arrived, and must stay. (With hw.coded a column arrives as a whole.)
  const int arrived = wanted.pass.tile + (machine_.configuration().coded ? 0 : 1);
  if (wanted.left != nullptr && shape_.owner(place.x / shape_.lanes) < arrived &&
      !same_cells(*wanted.left, machine_.written(), place.x, cells, place.y, place.z))
    for (int lane = 0; lane < cells; ++lane)
      compare_memory(channel, *wanted.left, lane,
                     wanted_cell(machine_.written(), place.x + lane, place.y, place.z));
}

void Checker::compare_memory(const Channel& channel, const state::Volume& volume, int lane, const Cell& is) {
  const Place& place = channel.left;
  const Cell wanted = wanted_cell(volume, place.x + lane, place.y, place.z);
  const auto differs = [&](std::string_view field, std::int64_t a, std::int64_t b) {
    if (a != b && mismatch_ == nullptr)
      report(channel, Mismatch::Kind::memory, channel.leaving, place, lane, field, a, b);
  };
  for (const CellWire& row : kCellWires)
    if (row.in_memory) differs(row.label, row.get(wanted), row.get(is));
}

void Checker::compare_pass(const Channel& channel) {
  const Wanted& wanted = passes_[channel.leaving - written_];
  if (wanted.pass.tile + 1 < shape_.tiles()) return;
  if (wanted.left != nullptr && mismatch_ == nullptr && !(*wanted.left == machine_.written())) {
    const Difference d = first_difference(*wanted.left, machine_.written());
    if (!d.field.empty()) {
      const int lane = d.x % shape_.lanes;
      report(channel, Mismatch::Kind::memory, channel.leaving, {d.x - lane, d.y, d.z}, lane, "", d.expected,
             d.actual);
      mismatch_->field = d.field;
      mismatch_->cycle = written_in(owned_ordinal(shape_, d.x, d.y, d.z));
    }
  }
  const std::optional<state::Holdings>& held = wanted.held;
  if (!held) return;
  const Books& books = machine_.books();
  const auto differs = [&](std::string_view field, std::int64_t a, std::int64_t b) {
    if (a != b && mismatch_ == nullptr)
      report(channel, Mismatch::Kind::books, channel.leaving, channel.left, 0, field, a, b);
  };
  differs("cells", shape_.grid.cells(), books.cells);
  differs("mass", static_cast<std::int64_t>(held->solid + held->liquid), books.mass);
  differs("energy", static_cast<std::int64_t>(held->energy), books.energy);
  differs("heat", static_cast<std::int64_t>(held->heat), books.heat);
}

void Checker::report(const Channel& channel, Mismatch::Kind kind, std::size_t pass, const Place& place,
                     int lane, std::string_view field, std::int64_t expected, std::int64_t actual) {
  const Wanted& wanted = passes_[pass - written_];
  const bool written = kind == Mismatch::Kind::memory || kind == Mismatch::Kind::books,
             in_channel = kind == Mismatch::Kind::channel;
  report({
      .kind = kind,
      .where =
          in_channel ? channel.name : std::string(name_of(written ? StageKind::writer : channel.producer)),
      .phase = written ? std::nullopt : phase_of(channel.producer),
      .step = wanted.pass.first +
              (written ? static_cast<std::uint32_t>(wanted.steps.size()) - 1 : channel.cascade),
      .cascade = channel.cascade,
      .lane = lane,
      .cycle = machine_.cycle(),
      .x = place.x + lane,
      .y = place.y,
      .z = place.z,
      .field = std::string(field),
      .expected = expected,
      .actual = actual,
  });
}

void Checker::report(Mismatch mismatch) {
  if (mismatch_ != nullptr) return;
  mismatch_ = std::make_unique<Mismatch>(std::move(mismatch));
  if (stops_) machine_.stop();
}

}  // namespace voxmelt::hwmodel
