// The parts of a packet share vectors of three components, and arithmetic of render/rule, lane by lane.
#pragma once

#include <cstdint>

#include "kernel/engine/cpu/word_lanes.h"

namespace voxmelt::render {

template <class Arch>
struct Packet {
  using L = cpu::WordLanes<Arch>;
  using V = typename L::V;
  using F = typename L::F;
  static constexpr int kCount = L::kCount;

  // Sums and products wrap.
  VOXMELT_WORDS V plus(V a, V b) { return L::as_signed(L::as_unsigned(a) + L::as_unsigned(b)); }
  VOXMELT_WORDS V times(V a, V b) { return L::as_signed(L::as_unsigned(a) * L::as_unsigned(b)); }
  struct Triple {
    V x, y, z;
    [[gnu::always_inline]] friend Triple operator+(Triple a, Triple b) {
      return {plus(a.x, b.x), plus(a.y, b.y), plus(a.z, b.z)};
    }
    [[gnu::always_inline]] friend Triple operator-(Triple a, Triple b) {
      return {plus(a.x, -b.x), plus(a.y, -b.y), plus(a.z, -b.z)};
    }
    [[gnu::always_inline]] friend Triple operator*(Triple a, V s) {
      return {times(a.x, s), times(a.y, s), times(a.z, s)};
    }
    [[gnu::always_inline]] friend Triple operator>>(Triple a, int n) {
      return {a.x >> n, a.y >> n, a.z >> n};
    }
    [[gnu::always_inline]] friend Triple operator<<(Triple a, int n) {
      return {a.x << n, a.y << n, a.z << n};
    }
  };
  VOXMELT_WORDS Triple select(V mask, Triple a, Triple b) {
    return {mask ? a.x : b.x, mask ? a.y : b.y, mask ? a.z : b.z};
  }
  VOXMELT_WORDS V dot(Triple a, Triple b) {
    return plus(plus(times(a.x, b.x), times(a.y, b.y)), times(a.z, b.z));
  }
  VOXMELT_WORDS V magnitude(V a) { return L::max(a, -a); }
  VOXMELT_WORDS V largest(Triple a) { return L::max(L::max(magnitude(a.x), magnitude(a.y)), magnitude(a.z)); }

  // Returns a vector of components within 2^15, brought to the length 2^14 (rule/normal.h). `roots` is
  // PictureData::inverse_root.
  VOXMELT_WORDS Triple unit(Triple a, const std::uint32_t* roots) {
    const V most = largest(a), nothing = most == 0;
    a = a * L::power_of_two(nothing ? V{} : 15 - L::bits_of(most));
    const V square = dot(a, a);  // read as unsigned
    const V small = (L::as_signed(L::as_unsigned(square) >> 30)) == 0;
    const V scaled = small ? square << 2 : square;
    V i = L::as_signed(L::as_unsigned(scaled) >> 23) - 128;
    i = L::clamp(i, 0, 383);  // for lanes of length 0
    const V entry = L::template gather<4>(roots, i);
    const V root = entry & 0xFFFF, less = L::as_signed(L::as_unsigned(entry) >> 16);
    V scale = root - ((less * (scaled & 0x7FFFFF) + (1 << 22)) >> 23);
    scale = small ? scale << 1 : scale;
    const auto component = [&](V c) { return (c * scale + (1 << 15)) >> 16; };
    return {component(a.x), component(a.y), component(a.z)};
  }
  // Returns a unit vector. Components of more than 15 bits are shifted down first.
  VOXMELT_WORDS Triple unit_of(Triple a, const std::uint32_t* roots) {
    const V bits = L::bits_of(largest(a)), more = bits > 15 ? bits - 14 : V{};
    Triple b = a;
    // At most a few different counts occur. Shifts by one each are the same on every processor.
    for (V left = more; L::any(left > 0); left = left - 1) b = select(left > 0, b >> 1, b);
    return unit(b, roots);
  }

  // Returns a + (b - a) share / 2^12, to nearest (rule/look.h).
  VOXMELT_WORDS V mixed(V a, V b, V share) { return a + (((b - a) * share + 2048) >> 12); }
  VOXMELT_WORDS V mixed(std::int32_t a, std::int32_t b, V share) {
    return L::set(a) + (((b - a) * share + 2048) >> 12);
  }
};

}  // namespace voxmelt::render
