// A fault of the channel behind the middle stage of the first time step in which it may strike. It strikes
// the first token in which it makes a difference.
#pragma once

#include <cstdint>

#include "hwmodel/faults/faults.h"
#include "hwmodel/stream/pipeline.h"

namespace voxmelt::hwmodel {

class ChannelFault final : public FifoFault<Cell> {
 public:
  // Both must outlive it. It does nothing if the plan's fault is not a channel's.
  ChannelFault(FaultPlan& plan, Pipeline& pipeline) : plan_(plan), pipeline_(pipeline) {}
  ~ChannelFault() override { take_out(); }
  ChannelFault(const ChannelFault&) = delete;
  ChannelFault& operator=(const ChannelFault&) = delete;

  // Must be called before a pass of `steps` time steps from number `first`.
  void begin_pass(std::uint32_t first, int steps);

  Effect stores(std::int64_t ordinal, Cell* now, Cell* last, int waiting) override;

 private:
  void take_out();
  // Rotates the lanes of the token, unless all are the same.
  Effect swap_lanes(std::int64_t ordinal, Cell* now);
  // The first lane in which two tokens differ; the number of lanes if none does.
  int first_difference(const Cell* one, const Cell* other) const;
  void strike(std::int64_t ordinal, int lane);

  FaultPlan& plan_;
  Pipeline& pipeline_;
  CellFifo* channel_ = nullptr;
  std::uint32_t step_ = 0;
};

}  // namespace voxmelt::hwmodel
