// The pipeline is timed without its arithmetic. It has the same channels, lags, stalls, feeds and memory, and
// so the same cycles in a small part of the time. No cell decides when a stage moves.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel::explore {

using StoredTokens = std::vector<bool>;

struct TimedRun {
  rule::Parameters parameters;
  state::Grid grid;
  Configuration configuration;
  std::uint32_t first_step = 0;
  std::int64_t steps = 0;
  std::function<void()> poll;
  // Returns what the feeds read from a step of visibility on, or from the first step. If empty, they read
  // nothing.
  std::function<const IrradianceStream*(std::uint32_t step)> irradiance;
  // Returns the cells that fall in this step, or null. If empty, none ever falls.
  std::function<const FallStream*(std::uint32_t step)> falls;
  // Returns which tokens are stored before this step, by column and height, with hw.coded on a memory. If
  // empty, none are.
  std::function<const StoredTokens*(std::uint32_t step)> stored;
  std::vector<int> substeps{};  // as of Content
};

StoredTokens stored_tokens(const Design& design, const state::Volume& volume);

struct Timing {
  std::int64_t cycles = 0;
  bool hangs = false;
  std::vector<ChannelReport> channels;
};

Timing timing_of(const TimedRun& run, StreamMemory* memory);

// Names the channels of the main stream in its order, then those of the feeds.
std::vector<std::string> channel_names(const Design& design, const Configuration& configuration);

}  // namespace voxmelt::hwmodel::explore
