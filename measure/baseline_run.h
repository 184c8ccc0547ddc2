// The paper's program runs on a workload and is timed like voxmelt: the same state, as many steps before and
// while the clock runs.
//
// Its flow is gravity + spread + excess of the paper's law, and its heat includes melting. It does not know
// the viscous law. For such a workload it runs the paper's law on the same state: the parameters' paper part,
// liquid with full energy.
#pragma once

#include <optional>
#include <vector>

#include "measure/baseline/baseline.h"
#include "measure/measure.h"

namespace voxmelt::measure {

class BaselineRuns {
 public:
  // Returns nothing if the baseline cannot run the workload's parameters.
  static std::optional<BaselineRuns> of(const Workload& workload);

  Steps plain() const;
  std::optional<Steps> native() const;  // nothing on a processor that it was not compiled for

 private:
  BaselineRuns(const Workload& workload, rule::Parameters parameters, state::Volume start);

  template <baseline::Variant variant>
  Steps run() const;

  rule::Parameters parameters_;
  state::Volume start_;
  std::vector<float> irradiance_;
  int lead_steps_, steps_;
  bool has_heat_;
};

}  // namespace voxmelt::measure
