#include "hwmodel/pipeline/model/stage.h"

#include <algorithm>

namespace voxmelt::hwmodel {

Stage::Stage(StageKind kind, const Design& design, std::int64_t lag)
    : kind_(kind), design_(design), lag_(lag) {}

void Stage::begin_pass(step::Moment moment, bool bypass, int tile) {
  passes_ = {{moment, bypass, tile}};
  coming_ = leaving_ = 0;
  moves_ = filled_ = 0;
  came_ = left_ = begin_of(shape(), tile);
  spot_delay_ = 0;
  spot_lane_ = 0;
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
  return leaving_ > coming_ || (!passes_[coming_].bypass && !passes_[coming_ + 1].bypass);
}

bool Stage::cycle() {
  if (done()) {
    ++cycles_.fill_drain;
    return false;
  }
  const std::int64_t tokens = shape().tokens();
  const bool all_came = came_.ordinal >= tokens, next = all_came && may_take_next();
  const bool takes = !all_came || next;
  const bool bypass = passes_[coming_ + (next ? 1 : 0)].bypass;
  const bool gives = moves_ >= (passes_[leaving_].bypass ? 0 : lag_);
  if (takes && (!in_->valid() || (!bypass && !side_input_ready()))) {
    ++(coming_ == 0 && came_.ordinal == 0 ? cycles_.fill_drain : cycles_.starved);
    return false;
  }
  if (gives && !out_->ready()) {
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
  Cell* out = gives ? out_->put() : nullptr;
  if (takes && bypass)
    std::copy(in, in + lanes(), out);
  else
    advance(in, out);
  ++moves_;
  ++filled_;
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
