// Notes what both sides of every channel do in every cycle, so that two runs can be compared.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "hwmodel/fabric/fifo.h"

namespace voxmelt::hwmodel {

class ChannelTrace : public ChannelProbe {
 public:
  void cycle(int channel, const Sides& sides, const void* in, const void* out) override;

  std::int64_t cycles() const { return cycles_; }

  // The first cycle in which a channel did something else.
  struct Difference {
    std::int64_t cycle;
    int channel;
  };
  std::optional<Difference> difference(const ChannelTrace& other) const;

 private:
  struct Moment {
    std::uint16_t channel, sides;
    friend bool operator==(const Moment&, const Moment&) = default;
  };
  std::vector<Moment> moments_;
  std::int64_t cycles_ = 0;
};

}  // namespace voxmelt::hwmodel
