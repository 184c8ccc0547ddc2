// The paper's program on a workload, timed like ours: the same state, as many steps before and while the
// clock runs.
//
// Its flow is gravity + spread + excess of the paper's law. For a workload of the viscous law, which it does
// not know, it runs the paper's law on the same state: the parameters' paper part, liquid with full energy.
#pragma once

#include <optional>
#include <vector>

#include "bench/baseline/baseline.h"
#include "bench/measure/workloads.h"

namespace voxmelt::measure {

struct BaselineSeconds {  // per step
  double heat = 0, gravity = 0, spread = 0, excess = 0;
  double flow() const { return gravity + spread + excess; }
};

class BaselineRuns {
 public:
  // Nothing where the baseline cannot run the workload's parameters.
  static std::optional<BaselineRuns> of(const Workload& workload);

  BaselineSeconds plain() const;
  std::optional<BaselineSeconds> native() const;  // nothing on a processor that it was not compiled for
  bool has_heat() const { return has_heat_; }

 private:
  BaselineRuns(const Workload& workload, rule::Parameters parameters, state::Volume start);

  template <baseline::Variant variant>
  BaselineSeconds run() const;

  rule::Parameters parameters_;
  state::Volume start_;
  std::vector<float> irradiance_;
  int lead_steps_, steps_;
  bool has_heat_;
};

}  // namespace voxmelt::measure
