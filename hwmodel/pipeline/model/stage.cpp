#include "hwmodel/pipeline/model/stage.h"

#include <algorithm>

#include "hwmodel/pipeline/model/lag.h"

namespace voxmelt::hwmodel {

Stage::Stage(StageKind kind, const Design& design, std::int64_t lag)
    : kind_(kind),
      design_(design),
      lag_(lag),
      registers_(registers_of(kind, design)),
      waits_(static_cast<std::size_t>(registers_) * design.shape.lanes) {}

void Stage::begin_pass(step::Moment moment, bool bypass, int tile) {
  passes_ = {{moment, bypass, tile}};
  coming_ = leaving_ = 0;
  moves_ = filled_ = 0;
  came_ = left_ = begin_of(shape(), tile);
  spot_delay_ = 0;
  spot_lane_ = 0;
  waiting_ = behind_ = held_ = 0;
  holds_ = 0;
}

Place Stage::place_at(std::int64_t delay) const {
  const std::int64_t tokens = shape().tokens(), ordinal = came_.ordinal - delay;
  return place_of(shape(), std::clamp<std::int64_t>(ordinal < 0 ? ordinal + tokens : ordinal, 0, tokens - 1),
                  tile_at(delay));
}

// Returns true if the next pass may come, once all tokens of this one have. If both passes work, the next one
// pushes the last one out. If one is bypassed, the stage empties itself first.
bool Stage::may_take_next() const {
  if (coming_ + 1 == passes_.size()) return false;
  if (leaving_ > coming_ && waiting_ == 0) return true;
  const bool both_work = !passes_[coming_].bypass && !passes_[coming_ + 1].bypass;
  return both_work && came_.ordinal == shape().tokens() && behind_ == 0;
}

// Ends a move. A token that asked for it may hold the stage now.
void Stage::count_move() {
  if ((holds_ & 1) != 0) held_ = kDividerCycles;
  holds_ >>= 1;
}

// Makes a move behind the last token of a pass, when tokens are left in its registers alone.
bool Stage::empty_registers() {
  const bool leaves = waiting_ + behind_ == registers_;  // the oldest one has passed all of them
  if (leaves && !out_->ready()) {
    ++cycles_.blocked;
    return false;
  }
  ++cycles_.fill_drain;
  ++behind_;
  count_move();
  if (!leaves) return true;
  const Cell* oldest = wait_at((next_ + registers_ - waiting_) % registers_);
  std::copy(oldest, oldest + lanes(), out_->put());
  if (--waiting_ == 0) behind_ = 0;
  return true;
}

bool Stage::cycle() {
  if (done()) {
    ++cycles_.fill_drain;
    return false;
  }
  if (held_ > 0) {
    --held_;
    ++held_cycles_;
    ++cycles_.blocked;
    return false;
  }
  if (leaving_ > coming_ && waiting_ > 0 && !may_take_next()) return empty_registers();
  const std::int64_t tokens = shape().tokens();
  const bool all_came = came_.ordinal >= tokens, next = all_came && may_take_next();
  const bool takes = !all_came || next;
  const bool bypass = passes_[coming_ + (next ? 1 : 0)].bypass;
  const bool gives = moves_ >= (passes_[leaving_].bypass ? 0 : lag_);
  if (takes && (!in_->valid() || (!bypass && !side_input_ready()))) {
    ++(coming_ == 0 && came_.ordinal == 0 ? cycles_.fill_drain : cycles_.starved);
    return false;
  }
  const bool waits = gives && registers_ > 0 && !passes_[leaving_].bypass;  // it goes through the registers
  const bool leaves = gives && (!waits || waiting_ == registers_);
  if (leaves && !out_->ready()) {
    ++cycles_.blocked;
    return false;
  }
  ++(!takes ? cycles_.fill_drain : bypass ? cycles_.bypassed : cycles_.busy);

  if (next) {
    ++coming_;
    came_ = begin_of(shape(), passes_[coming_].tile);
  }
  if (came_.ordinal == 0) {
    if (!overlaps()) filled_ = 0;
    begin_step();
  }
  const Cell* in = takes ? in_->get() : nullptr;
  Cell* out = !gives ? nullptr : waits ? wait_at(next_) : out_->put();
  if (waits) {  // the oldest token leaves the place of the new one
    if (leaves) std::copy(out, out + lanes(), out_->put());
    waiting_ += leaves ? 0 : 1;
    next_ = (next_ + 1) % registers_;
  }
  if (takes && bypass)
    std::copy(in, in + lanes(), out);
  else
    advance(in, out);
  ++moves_;
  ++filled_;
  count_move();
  came_.next(shape());
  if (!gives) return true;
  left_.next(shape());
  if (left_.ordinal < tokens) return true;
  ++leaving_;
  if (!done()) left_ = begin_of(shape(), passes_[leaving_].tile);
  moves_ = coming_ == leaving_ ? came_.ordinal : 0;
  return true;
}

}  // namespace voxmelt::hwmodel
