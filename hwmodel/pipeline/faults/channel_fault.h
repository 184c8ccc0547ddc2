// The fault strikes the channel behind the middle stage of the first time step in which it may strike. It
// strikes the first token in which it makes a difference.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

class ChannelFault final : public FifoFault<Cell> {
 public:
  // The plan and the pipeline must outlive it. It does nothing if the plan's fault is not a channel's.
  ChannelFault(FaultPlan& plan, Pipeline& pipeline) : plan_(plan), pipeline_(pipeline) {}
  ~ChannelFault() override { take_out(); }
  ChannelFault(const ChannelFault&) = delete;
  ChannelFault& operator=(const ChannelFault&) = delete;

  // This must be called before each train of passes, and then before each of its passes.
  void begin_train();
  void add_pass(const Pass& pass);

  Effect stores(std::int64_t ordinal, Cell* now, Cell* last, int waiting) override;

 private:
  void take_out();
  // Rotates the lanes of the token, unless all are the same.
  Effect swap_lanes(std::int64_t ordinal, Cell* now);
  // Returns the first lane in which two tokens differ, or the number of lanes if none does.
  int first_difference(const Cell* one, const Cell* other) const;
  Place place_of_token(std::int64_t ordinal) const;
  void strike(std::int64_t ordinal, int lane);

  FaultPlan& plan_;
  Pipeline& pipeline_;
  CellFifo* channel_ = nullptr;
  std::vector<Pass> passes_;     // passes of the train
  std::uint32_t position_ = 0;   // position of the channel's time step in the cascade
  std::int64_t armed_from_ = 0;  // ordinal in the train
};

}  // namespace voxmelt::hwmodel
