// Some data of a pass cannot be told from the configuration. They are counted from the state with which the
// run begins.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/coded_state.h"
#include "hwmodel/pipeline/model/irradiance_stream.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel::explore {

struct Content {
  std::int64_t irradiance_bits = 0;  // bits that a time step reads
  std::int64_t coded_bits = 0;       // bits of the state with hw.coded, read or written, in whole bursts
  // For tiles, these are sums of the same bits over all blocks along x before each block, and at last over
  // all. They are empty if there are none.
  std::vector<std::int64_t> irradiance_before{}, coded_before{};

  bool falls = false;  // does a piece fall in the first step?

  // Sub-steps of the first steps, where the state decides on them. All that follow have as many as the last.
  // If empty, a step has as many as the machine has copies.
  std::vector<int> substeps{};
  int substeps_of(std::int64_t step, int copies) const {
    return substeps.empty() ? copies : substeps[std::min<std::size_t>(step, substeps.size() - 1)];
  }

  std::vector<std::int32_t> lit_columns{};    // bits of irradiance in each column of the grid
  std::vector<std::int32_t> coded_columns{};  // bursts of the state in each column

  static std::int64_t between(const std::vector<std::int64_t>& before, int first, int end) {
    if (before.empty()) return 0;
    return before[end] - before[first];
  }
};

// `irradiance` or `volume` is null if there is none.
Content content_of(const Design& design, const Irradiance* irradiance, const state::Volume* volume = nullptr);

}  // namespace voxmelt::hwmodel::explore
