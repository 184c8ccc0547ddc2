// These faults let falls take or bring the wrong amount or heat, let a set cell fall, or wrap the counter of
// heights late.
#pragma once

#include <algorithm>
#include <cstdint>

#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/gravity_stage.h"

namespace voxmelt::hwmodel {

class GravityFaults : public Planted {
 public:
  using Planted::Planted;
  using Faulty = Gravity<GravityFaults>;

  void released(Faulty& stage, const Falling& low, const Falling& high, bool blocked_above,
                std::int64_t& flow) {
    heat_before_ = low.heat;
    const std::int64_t space = kOne - low.amount;
    std::int64_t wrong = flow;
    if (armed(stage, Fault::gravity_wall_missed))
      wrong = std::min(stage.released(low, high, false, blocked_above), space);
    if (armed(stage, Fault::gravity_room)) {
      const std::int64_t ready = stage.released(low, high, high.beside_wall > 0, blocked_above);
      if (low.amount + ready <= kAmountMax) wrong = ready;
    }
    if (high.set > 0 && armed(stage, Fault::gravity_set_falls)) {
      Falling free = high;
      free.set = 0;
      wrong = std::min(stage.released(low, free, high.beside_wall > 0, blocked_above), space);
    }
    if (wrong == flow) return;
    flow = wrong;
    strike_word(stage, stage.line_, low);
  }

  void fell(Faulty& stage, Falling& low) {
    if (armed(stage, Fault::gravity_mix) && low.heat != heat_before_)
      low.heat = heat_before_;
    else if (armed(stage, Fault::gravity_one_more))
      low.amount = low.amount + 1;
    else
      return;
    strike_word(stage, stage.line_, low);
  }

  // Treats the end of one column and the start of the next as a pair.
  void column_ended(Faulty& stage, Falling& low, Falling& high, bool blocked_above) {
    if (!armed(stage, Fault::gravity_column_wrap)) return;
    Falling wrong_low = low, wrong_high = high;
    stage.move(wrong_low, wrong_high, blocked_above);
    if (wrong_low.amount <= low.amount) return;
    low = wrong_low;
    high = wrong_high;
    strike_word(stage, stage.line_, low);
  }

 private:
  UInt<16> heat_before_;  // heat of the lower cell
};

}  // namespace voxmelt::hwmodel
