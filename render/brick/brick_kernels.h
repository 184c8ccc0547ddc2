// The loops that fill bricks, written once: plain loops over rows of 16 numbers of 16 bits, which compilers turn into
// vectors. Everything is a template over the instruction set, so that the linker cannot take a function of one for
// another's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "render/brick/brick_loops.h"

namespace voxmelt::render {

template <class Arch>
struct BrickKernels {
  using Word = std::uint16_t;
  using Int [[gnu::vector_size(32)]] = std::int32_t;
  using Float [[gnu::vector_size(32)]] = float;
  static constexpr int kSide = kPlacesOfBrick, kWide = BrickSource::kWide;
  static constexpr std::size_t kRow = BrickPlaces::kRow, kSlice = kRow * kSide;

  [[gnu::always_inline]] static Word word(int value) { return static_cast<Word>(value); }
  [[gnu::always_inline]] static std::size_t at(int i) { return static_cast<std::size_t>(i); }

  static bool inner(const BrickSource& source) { return source.x >= 1 && source.x + kSide < source.cells_x; }

  static bool any(const Word* intensity, const BrickSource& source) {
    const bool whole = inner(source);
    for (int k = 0; k < kWide; ++k) {
      std::uint32_t found = 0;
      for (int j = 0; j < kWide; ++j) {
        const Word* row = intensity + source.slices[at(k)] + source.rows[at(j)];
        if (whole) {
          Word sum = 0;
          for (int i = 0; i < kWide; ++i) sum = word(sum | row[source.x - 1 + i]);
          found |= sum;
        } else {
          for (int i = source.x - 1; i < source.x - 1 + kWide; ++i)
            if (i >= 0 && i < source.cells_x) found |= row[i];
        }
      }
      if (found != 0) return true;
    }
    return false;
  }

  // (43 a + 170 b + 43 c + 128) >> 8 of the two bytes of each number: neither sum leaves 16 bits.
  [[gnu::always_inline]] static void filter(const Word* a, const Word* b, const Word* c, Word* to) {
#pragma GCC ivdep
    for (std::size_t i = 0; i < kRow; ++i) {
      const Word high = word(43 * word((a[i] >> 8) + (c[i] >> 8)) + 170 * (b[i] >> 8));
      const Word low = word(43 * word((a[i] & 255) + (c[i] & 255)) + 170 * (b[i] & 255) + 128);
      to[i] = word(high + (low >> 8));
    }
  }

  static void places(const Word* intensity, const BrickSource& source, BrickPlaces& to) {
    alignas(32) Word along_x[kWide][kWide][kRow], along_y[kWide][kSide][kRow];
    const bool whole = inner(source);
    for (int k = 0; k < kWide; ++k) {
      for (int j = 0; j < kWide; ++j) {
        const Word* row = intensity + source.slices[at(k)] + source.rows[at(j)];
        Word copy[kRow + 2] = {};
        if (whole) {
          row += source.x - 1;
        } else {
          for (int i = 0; i < kWide; ++i) {
            const int x = source.x - 1 + i;
            copy[i] = row[x < 0 ? 0 : x >= source.cells_x ? source.cells_x - 1 : x];
          }
          row = copy;
        }
        filter(row, row + 1, row + 2, along_x[k][j]);
      }
      for (int j = 0; j < kSide; ++j) filter(along_x[k][j], along_x[k][j + 1], along_x[k][j + 2], along_y[k][j]);
    }
    alignas(32) Word inside[kRow];
    for (int i = 0; i < static_cast<int>(kRow); ++i) inside[i] = i >= source.low[0] && i < source.high[0] ? 0xFFFF : 0;
    Word* row = to.cells.data();
    for (int k = 0; k < kSide; ++k)
      for (int j = 0; j < kSide; ++j, row += kRow) {
        if (k < source.low[2] || k >= source.high[2] || j < source.low[1] || j >= source.high[1]) {
          std::memset(row, 0, kRow * sizeof(Word));
          continue;
        }
        filter(along_y[k][j], along_y[k + 1][j], along_y[k + 2][j], row);
        for (std::size_t i = 0; i < kRow; ++i) row[i] &= inside[i];
      }
  }

  struct Lanes {
    alignas(32) Word most[kRow], x[kRow], y[kRow], z[kRow];
  };
  [[gnu::always_inline]] static Word larger(Word a, Word b) { return a > b ? a : b; }
  [[gnu::always_inline]] static Word apart(Word a, Word b) { return a > b ? word(a - b) : word(b - a); }

  // A block has the places 1 to 5, or 5 to 9.
  static void ranges(const BrickPlaces& places, BlockRanges& to) {
    for (int half_z = 0; half_z < 2; ++half_z)
      for (int half_y = 0; half_y < 2; ++half_y) {
        Lanes of{};
        for (int k = 0; k < 5; ++k)
          for (int j = 0; j < 5; ++j) {
            const Word* row = places.cells.data() + at(1 + 4 * half_z + k) * kSlice + at(1 + 4 * half_y + j) * kRow;
            const Word keep_y = j < 4 ? 0xFFFF : 0, keep_z = k < 4 ? 0xFFFF : 0;
#pragma GCC ivdep
            for (std::size_t i = 0; i < kRow; ++i) {
              of.most[i] = larger(of.most[i], row[i]);
              of.y[i] = larger(of.y[i], word(apart(row[i + kRow], row[i]) & keep_y));
              of.z[i] = larger(of.z[i], word(apart(row[i + kSlice], row[i]) & keep_z));
            }
#pragma GCC ivdep
            for (std::size_t i = 0; i < kRow - 1; ++i) of.x[i] = larger(of.x[i], apart(row[i + 1], row[i]));
          }
        for (int half_x = 0; half_x < 2; ++half_x) {
          const int block = half_x + 2 * half_y + 4 * half_z, first = 1 + 4 * half_x;
          const auto largest = [&](const Word* lanes, int count) {
            Word most = 0;
            for (int i = first; i < first + count; ++i) most = larger(most, lanes[i]);
            return most;
          };
          to.most[at(block)] = largest(of.most, 5);
          to.along_x[at(block)] = largest(of.x, 4);
          to.along_y[at(block)] = largest(of.y, 5);
          to.along_z[at(block)] = largest(of.z, 5);
        }
      }
  }

  static void levels(const BrickPlaces& places, std::int16_t* to) {
    const Word* row = places.cells.data();
    for (int r = 0; r < kSide * kSide; ++r, row += kRow, to += kSide) {
      std::int16_t levels[kRow];
      for (std::size_t i = 0; i < kRow; ++i) levels[i] = static_cast<std::int16_t>(row[i] - 32640);
      std::memcpy(to, levels, kSide * sizeof(std::int16_t));
    }
  }

  // The numerators have 24 bits and the quotients 8. A quotient by less than 2^17 is never rounded up to a whole
  // number; that of the obstacles, by less than 2^18, is mended.
  template <bool kObstacles, bool kHeat>
  [[gnu::always_inline]] static void words(const Word* solid, const Word* liquid, const Word* heat, const Word* obstacle,
                                           const Word* place, const std::uint8_t* heats, std::uint32_t* to) {
    constexpr int kGroup = 8;
    std::int32_t of[kGroup], step[kGroup];
    for (int i = 0; i < kGroup; ++i) {
      const std::int32_t soft = liquid[i], all = solid[i] + soft;
      of[i] = static_cast<std::int32_t>(static_cast<float>(255 * soft) / static_cast<float>(all < 1 ? 1 : all));
      if constexpr (kObstacles) {
        const std::int32_t sum = all + obstacle[i], divisor = sum < 1 ? 1 : sum, numerator = 255 * obstacle[i];
        std::int32_t share = static_cast<std::int32_t>(static_cast<float>(numerator) / static_cast<float>(divisor));
        share -= share * divisor > numerator ? 1 : 0;
        of[i] |= share << 16;
      }
    }
    if constexpr (kHeat) {
      for (int i = 0; i < kGroup; ++i) {
        const float quotient = static_cast<float>(heat[i] * 256) / static_cast<float>(liquid[i] < 1 ? 1 : liquid[i]);
        step[i] = static_cast<std::int32_t>(quotient < 256.0f ? quotient : 256.0f);
      }
      for (int i = 0; i < kGroup; ++i) of[i] |= liquid[i] == 0 ? 0 : heats[step[i]] << 8;
    }
    for (int i = 0; i < kGroup; ++i) to[i] = place[i] == 0 ? 0u : static_cast<std::uint32_t>(of[i]);
  }

  template <bool kObstacles, bool kHeat>
  static void matter_of(const MatterSource& matter, const BrickSource& source, const BrickPlaces& places,
                        std::uint32_t* to) {
    const bool whole = source.low[0] == 0 && source.high[0] == kSide;
    const Word* place = places.cells.data();
    for (int k = 0; k < kSide; ++k)
      for (int j = 0; j < kSide; ++j, place += kRow, to += kSide) {
        const std::ptrdiff_t cell = static_cast<std::ptrdiff_t>(source.slices[at(k + 1)] + source.rows[at(j + 1)]) + source.x;
        const auto get = [&](const Word* from, Word* row) __attribute__((always_inline)) {
          if (whole) {
            std::memcpy(row, from + cell, kRow * sizeof(Word));
          } else {
            for (int i = 0; i < static_cast<int>(kRow); ++i)
              row[i] = i >= source.low[0] && i < source.high[0] ? from[cell + i] : Word{0};
          }
        };
        Word solid[kRow], liquid[kRow], heat[kRow], obstacle[kRow];
        get(matter.liquid, liquid);
        if constexpr (kObstacles) get(matter.obstacle, obstacle);
        Word any = 0;
        for (int i = 0; i < kSide; ++i) any = word(any | liquid[i]);
        if constexpr (kObstacles)
          for (int i = 0; i < kSide; ++i) any = word(any | obstacle[i]);
        if (any == 0) {
          std::memset(to, 0, kSide * sizeof(std::uint32_t));
          continue;
        }
        get(matter.solid, solid);
        if constexpr (kHeat) get(matter.heat, heat);
        for (const int i : {0, kSide - 8})
          words<kObstacles, kHeat>(solid + i, liquid + i, heat + i, obstacle + i, place + i, matter.heats, to + i);
      }
  }
  static void matter(const MatterSource& matter, const BrickSource& source, const BrickPlaces& places, std::uint32_t* to) {
    const bool obstacles = matter.obstacle != nullptr, heat = matter.heat != nullptr;
    if (obstacles && heat) return matter_of<true, true>(matter, source, places, to);
    if (obstacles) return matter_of<true, false>(matter, source, places, to);
    if (heat) return matter_of<false, true>(matter, source, places, to);
    matter_of<false, false>(matter, source, places, to);
  }
};

template <class Arch>
BrickLoops brick_loops_for() {
  using Of = BrickKernels<Arch>;
  return {Of::any, Of::places, Of::ranges, Of::levels, Of::matter};
}

}  // namespace voxmelt::render
