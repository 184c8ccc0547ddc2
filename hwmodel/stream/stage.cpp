#include "hwmodel/stream/stage.h"

#include <algorithm>

namespace voxmelt::hwmodel {

Stage::Stage(StageKind kind, const Design& design, std::int64_t lag)
    : kind_(kind), design_(design), lag_(lag) {}

void Stage::begin_pass(step::Moment moment, bool bypass) {
  moment_ = moment;
  bypass_ = bypass;
  moves_ = 0;
  came_ = left_ = {};
  spot_delay_ = 0, spot_lane_ = 0;
  begin_step();
}

Spot Stage::spot() const {
  const std::int64_t last = shape().tokens() - 1;
  return {place_of(shape(), std::clamp<std::int64_t>(came_.ordinal - spot_delay_, 0, last)), spot_lane_};
}

bool Stage::cycle() {
  const std::int64_t tokens = shape().tokens();
  const std::int64_t lag = bypass_ ? 0 : lag_;
  const bool takes = moves_ < tokens, gives = moves_ >= lag && !done();
  if (done()) {
    ++cycles_.fill_drain;
    return false;
  }
  if (takes && (!in_->valid() || (!bypass_ && !side_input_ready()))) {
    ++(moves_ == 0 ? cycles_.fill_drain : cycles_.starved);
    return false;
  }
  if (gives && !out_->ready()) {
    ++cycles_.blocked;
    return false;
  }
  ++(!takes ? cycles_.fill_drain : bypass_ ? cycles_.bypassed : cycles_.busy);

  const Cell* in = takes ? in_->get() : nullptr;
  Cell* out = gives ? out_->put() : nullptr;
  if (bypass_)
    std::copy(in, in + lanes(), out);
  else
    advance(in, out);
  ++moves_;
  came_.next(shape());
  if (gives) left_.next(shape());
  return true;
}

}  // namespace voxmelt::hwmodel
