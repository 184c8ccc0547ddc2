#include "hwmodel/pipeline/check/diagnosis.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/shape.h"
#include "hwmodel/pipeline/model/stage_kind.h"

namespace voxmelt::hwmodel {

Mismatch hang_of(const StreamMachine& machine, const Pass& first, std::int64_t cycle) {
  Mismatch m{.kind = Mismatch::Kind::hang, .step = first.first, .cycle = cycle};
  std::string full, empty;
  const std::vector<ChannelReport> channels = machine.channels();
  std::size_t last_full = 0;
  std::size_t last = 0;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const ChannelReport& channel = channels[i];
    const bool feed = is_feed(channel.producer);
    if (!feed) last = i;
    if (!feed && channel.count == channel.depth) last_full = i;
    std::string& list = channel.count == channel.depth ? full : empty;
    if (channel.count == channel.depth || channel.count == 0)
      list += (list.empty() ? "" : "; ") + channel.name;
  }
  const ChannelReport& blamed = channels[std::min(last_full + 1, last)];
  const Shape& shape = machine.design().shape;
  const std::int64_t streamed = first.tile + blamed.entered / shape.tokens();
  const Place place =
      place_of(shape, blamed.entered % shape.tokens(), static_cast<int>(streamed % shape.tiles()));
  m.where = blamed.name;
  m.phase = phase_of(blamed.producer);
  m.cascade = blamed.cascade;
  const auto passes = static_cast<std::uint32_t>(streamed / shape.tiles());  // all but the last are alike
  m.step += passes * first.steps + blamed.cascade;
  m.x = place.x;
  m.y = place.y;
  m.z = place.z;
  m.detail = "full, and who reads takes nothing: " + (full.empty() ? "none" : full) +
             "\n  empty, and who reads waits: " + (empty.empty() ? "none" : empty);
  return m;
}

// Reports that the pass took other cycles than the closed form says. No stage waits where channels hold two
// tokens.
Mismatch cycles_of(const StreamMachine& machine, std::uint32_t first_step, std::int64_t predicted,
                   std::int64_t cycles) {
  std::string waited;
  for (const StageReport& stage : machine.stages())
    if (!is_feed(stage.kind) && stage.cycles.starved + stage.cycles.blocked > 0)
      waited += (waited.empty() ? "" : ", ") + std::string(name_of(stage.kind)) + " of time step " +
                std::to_string(stage.cascade);
  return {.kind = Mismatch::Kind::cycles,
          .where = "pipeline",
          .step = first_step,
          .field = "cycles",
          .expected = predicted,
          .actual = cycles,
          .detail = "waited since the first pass: " + (waited.empty() ? "none" : waited)};
}

}  // namespace voxmelt::hwmodel
