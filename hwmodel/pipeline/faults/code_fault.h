// These faults spoil the occupancy code (hw.coded). A token that holds something is left out, or the wrong
// token's bit is set. A stored token is lost, or the reader looks at the wrong bit.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/faults/faults.h"
#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {

class PlantedCode final : public CodeFault {
 public:
  // The plan and the pipeline must outlive it. It does nothing if the plan's fault is not one of these.
  PlantedCode(FaultPlan& plan, Pipeline& pipeline);
  ~PlantedCode() override { pipeline_.plant(static_cast<CodeFault*>(nullptr)); }
  PlantedCode(const PlantedCode&) = delete;
  PlantedCode& operator=(const PlantedCode&) = delete;

  // This must be called before each train of passes, and then before each of its passes.
  void begin_train() { passes_.clear(); }
  void add_pass(const Pass& pass) { passes_.push_back(pass); }

  void judged(std::int64_t pass, const Place& place, const Cell* lanes, bool& air) override;
  void stored(std::int64_t pass, const Place& place, const Cell* lanes, std::int64_t& at) override;
  void ended(std::int64_t pass, const Place& place, std::uint64_t* slot) override;
  void found(std::int64_t pass, const Place& place, const std::uint64_t* slot, bool& stored) override;

 private:
  const Pass& pass_at(std::int64_t pass) const { return passes_[pass]; }
  bool armed_at_writer(Fault fault, std::int64_t pass) const;
  int cells_of(const Place& place) const;
  void strike_writer(std::int64_t pass, const Place& place, int lane);

  FaultPlan& plan_;
  Pipeline& pipeline_;
  CodeLayout layout_;
  std::vector<Pass> passes_;  // passes of the train
  std::vector<Cell> before_;  // the token that was stored last
  Place before_at_;
};

}  // namespace voxmelt::hwmodel
