#include "hwmodel/pipeline/faults/channel_fault.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxmelt::hwmodel {

void ChannelFault::begin_train() {
  take_out();
  passes_.clear();
}

void ChannelFault::add_pass(const Pass& pass) {
  passes_.push_back(pass);
  if (channel_ != nullptr || plan_.fault() < Fault::fifo_overwrite || plan_.struck()) return;
  position_ = std::max(pass.first, plan_.first_step()) - pass.first;
  if (position_ >= static_cast<std::uint32_t>(pass.steps)) return;
  armed_from_ = (passes_.size() - 1) * pipeline_.design().shape.tokens();
  const std::vector<CellFifo*> channels = pipeline_.channels_behind_stages(position_);
  channel_ = channels[channels.size() / 2];
  channel_->plant(this);
}

void ChannelFault::take_out() {
  if (channel_ != nullptr) channel_->plant(nullptr);
  channel_ = nullptr;
}

FifoFault<Cell>::Effect ChannelFault::stores(std::int64_t ordinal, Cell* now, Cell* last, int waiting) {
  if (plan_.struck() || ordinal < armed_from_) return Effect::none;
  const Shape& shape = pipeline_.design().shape;
  const int lanes = shape.lanes, tile = passes_[ordinal / shape.tokens()].tile;
  // A tile spoils cells beside a cut in any case. They are not compared.
  if (!shape.owns(tile, place_of_token(ordinal).x)) return Effect::none;
  const int lane = first_difference(now, last);
  const bool differs = ordinal > armed_from_ && lane < lanes;
  switch (plan_.fault()) {
    case Fault::fifo_never_ready:
      strike(ordinal + 1, 0);  // the next token never comes
      return Effect::jammed;
    case Fault::fifo_swap_lanes:
      return swap_lanes(ordinal, now);
    case Fault::fifo_stale:
      if (!differs) break;
      std::copy_n(last, lanes, now);
      strike(ordinal, lane);
      break;
    case Fault::fifo_overwrite:
      if (!differs || waiting == 0 || !shape.owns(tile, place_of_token(ordinal - 1).x)) break;
      std::copy_n(now, lanes, last);
      strike(ordinal - 1, lane);
      return Effect::lost;
    default:
      break;
  }
  return Effect::none;
}

FifoFault<Cell>::Effect ChannelFault::swap_lanes(std::int64_t ordinal, Cell* now) {
  std::vector<Cell> rotated(now, now + pipeline_.design().shape.lanes);
  std::rotate(rotated.begin(), rotated.begin() + 1, rotated.end());
  const int lane = first_difference(now, rotated.data());
  if (lane == pipeline_.design().shape.lanes) return Effect::none;
  std::copy(rotated.begin(), rotated.end(), now);
  strike(ordinal, lane);
  return Effect::none;
}

int ChannelFault::first_difference(const Cell* one, const Cell* other) const {
  return static_cast<int>(std::mismatch(one, one + pipeline_.design().shape.lanes, other).first - one);
}

Place ChannelFault::place_of_token(std::int64_t ordinal) const {
  const Shape& shape = pipeline_.design().shape;
  const std::size_t pass = ordinal / shape.tokens();
  return place_of(shape, ordinal % shape.tokens(), passes_.at(std::min(pass, passes_.size() - 1)).tile);
}

void ChannelFault::strike(std::int64_t ordinal, int lane) {
  const Place place = place_of_token(ordinal);
  const std::size_t pass = ordinal / pipeline_.design().shape.tokens();
  const std::uint32_t step = passes_[pass].first + position_;
  plan_.strike({channel_->name(), step, place.x + lane, place.y, place.z});
}

}  // namespace voxmelt::hwmodel
