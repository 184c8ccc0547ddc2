// The loops work for any instruction set. They have enough independent chains to keep every unit busy.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "measure/lane_loops.h"

namespace voxmelt::measure {

template <class Arch>
struct Loops {
  using L = cpu::Lanes<Arch>;
  using V = typename L::V;
  static constexpr int kChains = 12;  // more than the latency of a multiply times multiplies a cycle

  // There are twelve variables and no array, because an array would be kept in memory.
  struct Chains {
    V a = L::set(65521), b = L::set(65420), c = L::set(65319), d = L::set(65218), e = L::set(65117),
      f = L::set(65016), g = L::set(64915), h = L::set(64814), i = L::set(64713), j = L::set(64612),
      k = L::set(64511), l = L::set(64410);
  };

  VOXMELT_LANES std::uint64_t finish(std::uint64_t rounds, const Chains& v, std::uint16_t* sink) {
    const V first = L::max(L::max(L::max(v.a, v.b), L::max(v.c, v.d)), L::max(v.e, v.f));
    const V second = L::max(L::max(L::max(v.g, v.h), L::max(v.i, v.j)), L::max(v.k, v.l));
    L::store(sink, L::max(first, second));
    return rounds * kChains * static_cast<std::uint64_t>(L::kCount);
  }

  // The register itself is named, so that the compiler adds no move and delays nothing.
#if defined(__aarch64__)
  VOXMELT_LANES void pin(V& v) { asm volatile("" : "+w"(v.data)); }
#else
  VOXMELT_LANES void pin(V& v) { asm volatile("" : "+x"(v.data)); }
#endif
  template <class Operation>
  VOXMELT_LANES void each(Chains& v, const Operation& operation) {
    operation(v.a, v.b);
    operation(v.b, v.c);
    operation(v.c, v.d);
    operation(v.d, v.e);
    operation(v.e, v.f);
    operation(v.f, v.g);
    operation(v.g, v.h);
    operation(v.h, v.i);
    operation(v.i, v.j);
    operation(v.j, v.k);
    operation(v.k, v.l);
    operation(v.l, v.a);
  }

  static std::uint64_t multiply(std::uint64_t rounds, std::uint16_t* sink) {
    Chains v;
    const V factor = L::set(65535);
    for (std::uint64_t r = 0; r < rounds; ++r)
      each(v, [&](V& one, V&) VOXMELT_LAMBDA {
        one = L::high(one, factor);
        pin(one);
      });
    return finish(rounds, v, sink);
  }

  static std::uint64_t add(std::uint64_t rounds, std::uint16_t* sink) {
    Chains v;
    for (std::uint64_t r = 0; r < rounds; ++r)
      each(v, [&](V& one, V& next) VOXMELT_LAMBDA {
        one = one + next;
        pin(one);
      });
    return finish(rounds, v, sink);
  }

  static void update(std::uint16_t* at, std::size_t lanes) {
    const V some = L::set(3);
    for (std::size_t i = 0; i < lanes; i += L::kCount) L::store(at + i, L::load(at + i) + some);
  }
};

template <class Arch>
LaneLoops loops_for() {
  return {Loops<Arch>::multiply, Loops<Arch>::add, Loops<Arch>::update};
}

}  // namespace voxmelt::measure
