#include "hwmodel/check/channel_trace.h"

#include <algorithm>

namespace voxmelt::hwmodel {

// All channels tell of a cycle in the same order. So the first one begins the next.
void ChannelTrace::cycle(int channel, const Sides& sides, const void* /*in*/, const void* /*out*/) {
  if (moments_.empty() || moments_.front().channel == channel) ++cycles_;
  const int bits = int{sides.ready} | int{sides.put} << 1 | int{sides.valid} << 2 | int{sides.get} << 3;
  moments_.push_back(
      {static_cast<std::uint16_t>(channel), static_cast<std::uint16_t>(sides.count << 4 | bits)});
}

std::optional<ChannelTrace::Difference> ChannelTrace::difference(const ChannelTrace& other) const {
  const auto [mine, its] =
      std::mismatch(moments_.begin(), moments_.end(), other.moments_.begin(), other.moments_.end());
  if (mine == moments_.end() && its == other.moments_.end()) return {};
  const auto at = mine - moments_.begin();
  const std::int64_t cycle =
      moments_.empty() ? 0 : std::count_if(moments_.begin(), mine, [this](const Moment& moment) {
        return moment.channel == moments_.front().channel;
      });
  const Moment& moment = mine != moments_.end() ? *mine : other.moments_[at];
  return Difference{cycle > 0 && moment.channel != moments_.front().channel ? cycle - 1 : cycle,
                    moment.channel};
}

}  // namespace voxmelt::hwmodel
