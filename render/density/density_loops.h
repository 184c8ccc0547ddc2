// The loops, written once over groups of eight cells, in the vector types that gcc and clang have for any
// processor. Everything is a template over the instruction set, so that the linker cannot take a function of
// one for another's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "render/density/loops.h"
#include "render/density/pyramid.h"

namespace voxmelt::render {

// For code of an instruction set that must not be shared with others.
template <class Arch>
struct DensityLoops {
  static constexpr int kGroup = 8;
  using U16 [[gnu::vector_size(16)]] = std::uint16_t;
  using I32 [[gnu::vector_size(32)]] = std::int32_t;
  using U32 [[gnu::vector_size(32)]] = std::uint32_t;
  using F32 [[gnu::vector_size(32)]] = float;
  using F32x4 [[gnu::vector_size(16)]] = float;

  template <class V, class T>
  [[gnu::always_inline]] static void load(V& to, const T* from) {
    static_assert(sizeof(V) == kGroup * sizeof(T));
    std::memcpy(&to, from, sizeof(V));
  }
  template <class V, class T>
  [[gnu::always_inline]] static void store(const V& from, T* to) {
    std::memcpy(to, &from, sizeof(V));
  }
  // The conversion is element by element: g++ 12 makes one instruction of it, but five of a conversion of
  // the vector.
  template <class To>
  [[gnu::always_inline]] static void load_as(To& to, const std::uint16_t* p) {
    to = To{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]};
  }

  // The first `count` cells at most; zeros for the others, and where `cells` is null.
  [[gnu::always_inline]] static void load_some(U16& to, const std::uint16_t* cells, int count) {
    to = U16{};
    if (cells == nullptr) return;
    if (count >= kGroup)
      load(to, cells);
    else
      for (int lane = 0; lane < count; ++lane) to[lane] = cells[lane];
  }

  // Rows of `sums` begin every `wide` numbers. There is one group more than needed, for the sums along x.
  static void low_pass(Block<const std::uint16_t> from, Block<std::uint16_t> to, int x, int y, int z,
                       std::uint32_t* sums) {
    const int groups = (x + 2 + kGroup - 1) / kGroup, wide = (groups + 1) * kGroup;
    std::uint32_t* const along_yz = sums + static_cast<std::ptrdiff_t>(wide) * (y + 2);  // one row
    for (int k = 0; k < z; ++k) {
      for (int j = 0; j < y + 2; ++j) {
        const std::uint16_t* row =
            from.cells + static_cast<std::size_t>(k) * from.slice + static_cast<std::size_t>(j) * from.row;
        std::uint32_t* sum = sums + static_cast<std::ptrdiff_t>(j) * wide;
        for (int i = 0; i < groups * kGroup; i += kGroup) {
          U32 a, b, c;
          load_as(a, row + i);
          load_as(b, row + from.slice + i);
          load_as(c, row + 2 * from.slice + i);
          store(a + b + b + c, sum + i);
        }
      }
      for (int j = 0; j < y; ++j) {
        const std::uint32_t* sum = sums + static_cast<std::ptrdiff_t>(j) * wide;
        for (int i = 0; i < groups * kGroup; i += kGroup) {
          U32 a, b, c;
          load(a, sum + i);
          load(b, sum + wide + i);
          load(c, sum + 2 * wide + i);
          store(a + b + b + c, along_yz + i);
        }
        std::uint16_t* row =
            to.cells + static_cast<std::size_t>(k) * to.slice + static_cast<std::size_t>(j) * to.row;
        for (int i = 0; i < x; i += kGroup) {
          U32 a, b, c;
          load(a, along_yz + i);
          load(b, along_yz + i + 1);
          load(c, along_yz + i + 2);
          store(__builtin_convertvector((a + b + b + c + 32) >> 6, U16), row + i);
        }
      }
    }
  }

  // Directly above a solid, the liquid's share is about 0.35 with a film of half a cell, and 0.9 with one of
  // two cells.
  static void weights(const std::uint16_t* liquid, const std::uint16_t* solid, const std::uint16_t* obstacle,
                      int count, std::uint16_t* weights) {
    constexpr float kFrom = 0.4f, kTo = 0.8f;
    for (int i = 0; i < count; i += kGroup) {
      U16 cells;
      I32 soft, hard, other;
      load_some(cells, liquid + i, count - i);
      soft = __builtin_convertvector(cells, I32);
      load_some(cells, solid + i, count - i);
      hard = __builtin_convertvector(cells, I32);
      load_some(cells, obstacle == nullptr ? nullptr : obstacle + i, count - i);
      other = __builtin_convertvector(cells, I32);
      I32 all = soft + hard + other;
      all = all < 1 ? I32{} + 1 : all;
      const F32 share = __builtin_convertvector(soft, F32) / __builtin_convertvector(all, F32);
      F32 t = (share - kFrom) / (kTo - kFrom);
      t = t < 0.0f ? F32{} : t;
      t = t > 1.0f ? F32{} + 1.0f : t;
      const F32 smooth = t * t * (3 - 2 * t);
      store(__builtin_convertvector(__builtin_convertvector(256 * smooth, I32), U16), weights + i);
    }
  }

  static void mix(const std::uint16_t* solid, const std::uint16_t* liquid, const std::uint16_t* weights,
                  int count, std::uint16_t* to) {
    for (int i = 0; i < count; i += kGroup) {
      U32 hard, soft, weight;
      load_as(hard, solid + i);
      load_as(soft, liquid + i);
      load_as(weight, weights + i);
      const U16 mixed = __builtin_convertvector((hard * (256 - weight) + soft * weight + 128) >> 8, U16);
      if (count - i >= kGroup)
        store(mixed, to + i);
      else
        for (int lane = 0; lane < count - i; ++lane) to[i + lane] = mixed[lane];
    }
  }

  static void range(Block<const std::uint16_t> from, int x, int y, int z, std::uint16_t* low,
                    std::uint16_t* high) {
    const auto each_row = [&](const auto& take) __attribute__((always_inline)) {
      for (int k = 0; k < z; ++k)
        for (int j = 0; j < y; ++j)
          take(from.cells + static_cast<std::size_t>(k) * from.slice +
               static_cast<std::size_t>(j) * from.row);
    };
    const std::uint16_t any = from.cells[0];
    std::uint16_t lowest = any, highest = any;
    const auto include = [&](std::uint16_t smallest, std::uint16_t largest) __attribute__((always_inline)) {
      lowest = smallest < lowest ? smallest : lowest;
      highest = largest > highest ? largest : highest;
    };
    if (x < kGroup) {
      each_row([&](const std::uint16_t* row) __attribute__((always_inline)) {
        for (int i = 0; i < x; ++i) include(row[i], row[i]);
      });
    } else {  // at most two groups: the first eight cells and the last
      U16 smallest = U16{} + any, largest = smallest;
      each_row([&](const std::uint16_t* row) __attribute__((always_inline)) {
        U16 first, last;
        load(first, row);
        load(last, row + x - kGroup);
        smallest = first < smallest ? first : smallest;
        largest = first > largest ? first : largest;
        smallest = last < smallest ? last : smallest;
        largest = last > largest ? last : largest;
      });
      for (int lane = 0; lane < kGroup; ++lane) include(smallest[lane], largest[lane]);
    }
    *low = lowest;
    *high = highest;
  }

  // The two cells of each pair, one after the other.
  [[gnu::always_inline]] static void add_pairs(F32x4& sum, const F32& values) {
    sum += 0.125f * __builtin_shufflevector(values, values, 0, 2, 4, 6);
    sum += 0.125f * __builtin_shufflevector(values, values, 1, 3, 5, 7);
  }

  static void shrink(const ShownRow* from, int rows, int count, const float* emission, Blend* to) {
    constexpr float kUnit = 1.0f / static_cast<float>(kFull);
    F32x4 matter{}, liquid{}, heat{}, glow{};
    for (int r = 0; r < rows; ++r) {
      U16 hard, soft, warm, other;
      load_some(hard, from[r].solid, count);
      load_some(soft, from[r].liquid, count);
      load_some(other, from[r].obstacle, count);
      std::uint64_t any[2];
      const U16 all_bits = hard | soft | other;
      std::memcpy(any, &all_bits, sizeof any);
      if ((any[0] | any[1]) == 0) continue;  // nor any heat
      load_some(warm, from[r].heat, count);

      const I32 soft32 = __builtin_convertvector(soft, I32), warm32 = __builtin_convertvector(warm, I32);
      I32 all = __builtin_convertvector(hard, I32) + __builtin_convertvector(other, I32) + soft32;
      all = all > kFull ? I32{} + kFull : all;
      const F32 soft_share = __builtin_convertvector(soft32, F32) * kUnit;
      add_pairs(matter, __builtin_convertvector(all, F32) * kUnit);
      add_pairs(liquid, soft_share);
      add_pairs(heat, __builtin_convertvector(warm32, F32) * kUnit);

      // The temperature heat / liquid in 256 steps: this quotient is never rounded up to a whole number.
      const I32 divisor = soft32 < 1 ? I32{} + 1 : soft32;
      const F32 step = __builtin_convertvector(warm32 * 256, F32) / __builtin_convertvector(divisor, F32);
      I32 whole = __builtin_convertvector(step, I32);
      whole = whole > 256 ? I32{} + 256 : whole;
      F32 light;
      for (int lane = 0; lane < kGroup; ++lane) light[lane] = emission[whole[lane]];
      add_pairs(glow, soft_share * light);
    }
    for (int i = 0; i < kGroup / 2; ++i) {
      to[i].matter = matter[i];
      to[i].liquid = liquid[i];
      to[i].heat = heat[i];
      to[i].glow = glow[i];
    }
  }
};

template <class Arch>
Loops loops_for() {
  using Of = DensityLoops<Arch>;
  return {Of::low_pass, Of::weights, Of::mix, Of::range, Of::shrink};
}

}  // namespace voxmelt::render
