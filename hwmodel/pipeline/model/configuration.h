// These numbers configure a pipeline, and a table has their keys in [hw]. Presets, `--set`, the reports,
// `explore` and the files that the program writes follow from the table.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "hwmodel/fabric/key.h"

namespace voxmelt::hwmodel {

struct ChannelDepth {
  std::string name;  // "step 0: gravity -> pattern"
  int depth = 0;
};

struct Configuration {
  int lanes = 4;                       // P: cells per cycle, along x
  int cascade = 1;                     // T: time steps per pass
  int fifo_depth = 4;                  // tokens in every channel
  std::uint64_t stall_seed = 0;        // 0: no stalls
  int substeps = 1;                    // viscous law: copies of settle and spread in a time step
  bool overlap = true;                 // may a pass enter while the last one drains?
  int tile = 0;                        // cells along x that the memories hold, in whole blocks; 0: the grid
  bool coded = false;                  // the state in memory has one bit for a token of air
  bool registers = false;              // stages have the registers of their circuits (docs/hardware/rtl.md)
  std::vector<ChannelDepth> depths{};  // channels that differ from fifo_depth

  int depth_of(const std::string& channel) const {
    for (const ChannelDepth& one : depths)
      if (one.name == channel) return one.depth;
    return fifo_depth;
  }
  // Returns the cycles per token of the stream. A channel of depth 1 passes a token every second cycle, and
  // then so does the stream.
  int interval() const { return fifo_depth == 1 || has_single() ? 2 : 1; }
  // Returns true if every channel has room for two tokens, or none has. Otherwise the cycles have no closed
  // form.
  bool channels_alike() const { return depths.empty() || (fifo_depth > 1 && !has_single()); }
  bool has_single() const {
    return std::any_of(depths.begin(), depths.end(), [](const ChannelDepth& one) { return one.depth == 1; });
  }
};

inline constexpr int kMostLanes = 32, kMostCascade = 16, kMostDepth = 1024, kMostSubsteps = 64,
                     kMostTile = 65536;

using HwKey = Key<Configuration>;

// The key hw.tile is a multiple of the lanes, so it must be read after them.
inline constexpr std::array kHwKeys{
    hw_key<&Configuration::lanes>("lanes", 1, kMostLanes, "1 .. 32"),
    hw_key<&Configuration::cascade>("cascade", 1, kMostCascade, "1 .. 16"),
    hw_key<&Configuration::substeps>("substeps", 1, kMostSubsteps, "1 .. 64"),
    hw_key<&Configuration::overlap>("overlap", 0, 1, "0, 1"),
    hw_key<&Configuration::tile>("tile", 0, kMostTile, "0: none"),
    hw_key<&Configuration::coded>("coded", 0, 1, "0, 1"),
    hw_key<&Configuration::registers>("registers", 0, 1, "0, 1"),
    hw_key<&Configuration::fifo_depth>("fifo_depth", 1, kMostDepth, "1 .. 1024"),
    hw_key<&Configuration::stall_seed>("stall_seed", 0, std::numeric_limits<std::int64_t>::max(), "0: none"),
};

}  // namespace voxmelt::hwmodel
