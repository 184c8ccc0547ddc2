// Pseudo-random stalls let any channel refuse a transfer in any cycle. No result may depend on them.
#pragma once

#include <cstdint>

namespace voxmelt::hwmodel {

class StallInjector {
 public:
  StallInjector() = default;
  // Seed 0 never stalls. Two channels, or two passes, have different streams. A pass always has the same one.
  StallInjector(std::uint64_t seed, std::uint64_t channel, std::uint64_t pass)
      : state_(seed == 0 ? 0 : mix(mix(seed * 0x9E3779B97F4A7C15u + channel + 1) + pass) | 1) {}

  struct Stall {
    bool put = false, get = false;
  };
  // Draws the stalls of the next cycle: each side stalls one time in four.
  Stall next() {
    if (state_ == 0) return {};
    state_ ^= state_ << 13;  // xorshift64
    state_ ^= state_ >> 7;
    state_ ^= state_ << 17;
    return {((state_ >> 20) & 3u) == 0, ((state_ >> 40) & 3u) == 0};
  }

 private:
  static std::uint64_t mix(std::uint64_t v) {
    v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
    v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
    return v ^ (v >> 31);
  }
  std::uint64_t state_ = 0;
};

}  // namespace voxmelt::hwmodel
