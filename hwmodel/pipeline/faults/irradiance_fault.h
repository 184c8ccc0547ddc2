// These faults spoil what a feed makes of the words of irradiance. It counts too few dark tokens, takes a
// mask of the wrong lanes, or takes a word too few. Or it gives the bits of pieces once more.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

class IrradianceFault final : public FeedFault {
 public:
  // The plan and the pipeline must outlive it. It does nothing if the plan's fault is not one of these.
  IrradianceFault(FaultPlan& plan, Pipeline& pipeline);
  ~IrradianceFault() override { pipeline_.plant(static_cast<FeedFault*>(nullptr)); }
  IrradianceFault(const IrradianceFault&) = delete;
  IrradianceFault& operator=(const IrradianceFault&) = delete;

  // This must be called before each train of passes, and then before each of its passes.
  void begin_train() { passes_.clear(); }
  void add_pass(const Pass& pass) { passes_.push_back(pass); }

  void counted(int t, std::int64_t pass, const Place& place, std::uint32_t mask, std::int64_t& dark) override;
  void told(std::int64_t pass, const Place& place, std::uint32_t before, std::uint32_t& mask) override;
  void masked(int t, std::int64_t pass, const Place& place, std::uint32_t& mask, bool& last_lost) override;

 private:
  std::uint32_t step_of(int t, std::int64_t pass) const { return passes_[pass].first + t; }
  void strike(std::uint32_t step, const Place& place, int lane, StageKind feed = StageKind::feed);

  FaultPlan& plan_;
  Pipeline& pipeline_;
  std::vector<Pass> passes_;  // passes of the train
};

}  // namespace voxmelt::hwmodel
