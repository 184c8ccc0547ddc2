// These faults spoil the cutting into tiles, beside the memory. A halo is wrong when it is read, or a cell of
// it is written or counted although another tile owns it.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

class TileFault final : public PortFault {
 public:
  // The plan and the pipeline must outlive it. It does nothing if the plan's fault is not one of these.
  TileFault(FaultPlan& plan, Pipeline& pipeline);
  ~TileFault() override { pipeline_.plant(static_cast<PortFault*>(nullptr)); }
  TileFault(const TileFault&) = delete;
  TileFault& operator=(const TileFault&) = delete;

  // This must be called before each train of passes, and then before each of its passes.
  void begin_train() { passes_.clear(); }
  void add_pass(const Pass& pass) { passes_.push_back(pass); }

  void reads(std::int64_t pass, const Place& place, const StateMemory& memory, Cell* lanes) override;
  int writes(std::int64_t pass, const Place& place, StateMemory& memory, const Cell* lanes) override;
  int counts(std::int64_t pass, const Place& place) override;

 private:
  const Pass& pass_at(std::int64_t pass) const { return passes_[pass]; }
  void give_border(const Place& place, const Pass& pass, Cell* lanes);
  void give_stale(const Place& place, const Pass& pass, const StateMemory& memory, Cell* lanes);

  FaultPlan& plan_;
  Pipeline& pipeline_;
  std::vector<Pass> passes_;  // passes of the train
};

}  // namespace voxmelt::hwmodel
