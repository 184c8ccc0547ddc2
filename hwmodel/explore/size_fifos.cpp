#include "hwmodel/explore/size_fifos.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"

namespace voxmelt::hwmodel::explore {
namespace {

class Sizer {
 public:
  Sizer(const TimedRun& run, const std::optional<SizingMemory>& memory)
      : run_(run), memory_(memory), design_(design_of(run.parameters, run.grid, run.configuration)) {}

  Sizing size() {
    run_.configuration.depths.clear();
    run_.configuration.fifo_depth = kMostDepth;
    const Timing deep = time();
    if (deep.hangs)
      throw std::runtime_error("the machine hangs even with channels of depth " + std::to_string(kMostDepth));
    sizing_.cycles = sizing_.deep_cycles = deep.cycles;
    for (const ChannelReport& channel : deep.channels) {
      sizing_.channels.push_back({channel.name, 0, channel.bits, channel.highest, 0});
      // A channel with room for one token more than it ever held acts as the deep one. One that held none, a
      // feed of this run, says nothing of its depth: with two it passes a token in every cycle.
      const int enough = channel.highest == 0 ? kOfIdle : channel.highest + 1;
      run_.configuration.depths.push_back({channel.name, std::min(kMostDepth, enough)});
    }
    for (std::size_t i = 0; i < sizing_.channels.size(); ++i)
      if (!idle(i)) shrink(run_.configuration.depths[i]);
    // Without a memory, more room never costs a cycle: a depth that once was too little stays too little when
    // others shrink. On a DRAM it may cost some, because requests then come in another order. So all channels
    // are tried until none yields.
    while (!one_less_costs()) {
    }
    return sizing_;
  }

 private:
  static constexpr int kOfIdle = 2;
  bool idle(std::size_t i) const { return sizing_.channels[i].highest == 0; }
  Timing time() {
    ++sizing_.runs;
    if (!memory_) return timing_of(run_, nullptr);
    MemoryStreams streams(design_, run_.configuration.cascade, memory_->parameters, memory_->clock_mhz);
    return timing_of(run_, &streams);
  }
  bool loses() {
    const Timing timing = time();
    if (timing.hangs || timing.cycles > sizing_.cycles) return true;
    sizing_.cycles = timing.cycles;
    return false;
  }
  // Says if one token less costs cycles in every channel, each taken alone. If one costs nothing, the channel
  // is made shallower. Its cycles are the new measure: they are not more than those of the deep machine.
  bool one_less_costs() {
    bool all = true;
    for (std::size_t i = 0; i < sizing_.channels.size(); ++i) {
      ChannelDepth& channel = run_.configuration.depths[i];
      SizedChannel& sized = sizing_.channels[i];
      sized.one_less = 0;
      for (; channel.depth > (idle(i) ? kOfIdle : 1); --channel.depth) {
        --channel.depth;
        const Timing less = time();
        ++channel.depth;
        sized.one_less = less.hangs ? INT64_MAX : less.cycles - sizing_.cycles;
        if (sized.one_less > 0 || !memory_) break;
        all = false;
        sizing_.cycles = less.cycles;
        sized.one_less = 0;
      }
      sized.depth = channel.depth;
    }
    return all;
  }
  // Searches by halving: `low` loses cycles, `high` does not.
  void shrink(ChannelDepth& channel) {
    int low = 0, high = channel.depth;
    while (low + 1 < high) {
      channel.depth = (low + high) / 2;
      (loses() ? low : high) = channel.depth;
    }
    channel.depth = high;
  }

  TimedRun run_;
  const std::optional<SizingMemory>& memory_;
  Design design_;
  Sizing sizing_;
};

}  // namespace

Sizing size_fifos(const TimedRun& run, const std::optional<SizingMemory>& memory) {
  return Sizer(run, memory).size();
}

std::string toml_of(const Sizing& sizing, const Configuration& c, const std::string& title) {
  std::string text = fmt::format("title = \"{}\"\n[hw]\n", title);
  for (const HwKey& key : kHwKeys)  // the depths are those of the channels
    if (key.name != "fifo_depth") text += fmt::format("{} = {}\n", key.name, key.get(c));
  for (const SizedChannel& channel : sizing.channels)
    text += fmt::format("[[hw.channel]]\nname = \"{}\"\ndepth = {}\n", channel.name, channel.depth);
  return text;
}

}  // namespace voxmelt::hwmodel::explore
