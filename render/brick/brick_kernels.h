// The loops that fill bricks are written once, in the vector types that g++ and clang have for any processor.
// Everything is a template over the instruction set, so that the linker cannot take a function of one for
// another's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "render/brick/brick_loops.h"

namespace voxmelt::render {

template <class Arch>
struct BrickKernels {
  using Word = std::uint16_t;
  using Words [[gnu::vector_size(32)]] = std::uint16_t;  // two rows of eight cells
  using Row [[gnu::vector_size(16)]] = std::uint16_t;
  using Int [[gnu::vector_size(32)]] = std::int32_t;
  using Float [[gnu::vector_size(32)]] = float;
  static constexpr int kCells = kCellsOfBrick, kWide = BrickSource::kWide, kSide = kPlacesOfBrick;
  static constexpr Word kToLevel = 32640;

  [[gnu::always_inline]] static std::size_t at(int i) { return i; }
  template <class V, class T>
  [[gnu::always_inline]] static void load(V& to, const T* from) {
    std::memcpy(&to, from, sizeof(V));
  }
  [[gnu::always_inline]] static bool any(const Row& row) {
    std::uint64_t halves[2];
    std::memcpy(halves, &row, sizeof halves);
    return (halves[0] | halves[1]) != 0;
  }

  // Computes (43 a + 170 b + 43 c + 128) >> 8 of the two bytes of each number. Neither sum leaves 16 bits.
  template <class V>
  [[gnu::always_inline]] static void filter(const V& a, const V& b, const V& c, V& to) {
    const V high = 43 * ((a >> 8) + (c >> 8)) + 170 * (b >> 8);
    const V low = 43 * ((a & 255) + (c & 255)) + 170 * (b & 255) + 128;
    to = high + (low >> 8);
  }

  // Filters two rows at a time, along x, then y, then z.
  static void filter_all(const Word* intensity, const BrickSource& source,
                         Word (&to)[kCells][kCells][kCells]) {
    alignas(32) Word along_x[kWide][kWide][kCells], along_y[kWide][kCells][kCells];
    const bool whole = source.x >= 1 && source.x + kCells < source.cells_x;
    for (int k = 0; k < kWide; ++k) {
      Word copies[2][kWide];
      for (int j = 0; j < kWide; j += 2) {
        const Word* rows[2];
        for (int r = 0; r < 2; ++r) {
          rows[r] = intensity + source.slices[at(k)] + source.rows[at(j + r)];
          if (whole) {
            rows[r] += source.x - 1;
            continue;
          }
          for (int i = 0; i < kWide; ++i) {
            const int x = source.x - 1 + i;
            copies[r][i] = rows[r][x < 0 ? 0 : x >= source.cells_x ? source.cells_x - 1 : x];
          }
          rows[r] = copies[r];
        }
        Words words[3], filtered;
        for (int i = 0; i < 3; ++i) {
          Row first, second;
          load(first, rows[0] + i);
          load(second, rows[1] + i);
          words[i] =
              __builtin_shufflevector(first, second, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        }
        filter(words[0], words[1], words[2], filtered);
        std::memcpy(along_x[k][j], &filtered, sizeof filtered);
      }
      // The rows between two pairs are put together from registers. Otherwise memory would be read before it
      // is written.
      Words low, high, between, filtered;
      load(low, along_x[k][0]);
      for (int j = 0; j < kCells; j += 2) {
        load(high, along_x[k][j + 2]);
        between =
            __builtin_shufflevector(low, high, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23);
        filter(low, between, high, filtered);
        std::memcpy(along_y[k][j], &filtered, sizeof filtered);
        low = high;
      }
    }
    for (int k = 0; k < kCells; ++k)
      for (int j = 0; j < kCells; j += 2) filter_rows(along_y[k][j], kCells * kCells, to[k][j]);
  }
  [[gnu::always_inline]] static void filter_rows(const Word* from, int step, Word* to) {
    Words a, b, c, filtered;
    load(a, from);
    load(b, from + step);
    load(c, from + 2 * step);
    filter(a, b, c, filtered);
    std::memcpy(to, &filtered, sizeof filtered);
  }

  [[gnu::always_inline]] static void wide(const Row& row, Int& to) { to = __builtin_convertvector(row, Int); }
  // The numerators have 24 bits and the quotients 9. A quotient by less than 2^17 is never rounded up to a
  // whole number.
  [[gnu::always_inline]] static void quotient(const Int& numerator, const Int& divisor, Int& to) {
    const Int one = divisor < 1 ? Int{} + 1 : divisor;
    to = __builtin_convertvector(
        __builtin_convertvector(numerator, Float) / __builtin_convertvector(one, Float), Int);
  }

  static bool cells(const Word* intensity, const MatterSource& matter, const BrickSource& source,
                    BrickCells& to) {
    alignas(32) Word filtered[kCells][kCells][kCells];
    filter_all(intensity, source, filtered);
    Int found{};
    Row inside;
    for (int i = 0; i < kCells; ++i) inside[i] = i < source.count_x ? 0xFFFF : 0;
    for (int k = 0; k < kCells; ++k)
      for (int j = 0; j < kCells; ++j) {
        const int r = (k * kCells + j) * kCells;
        const bool in = k < source.count_z && j < source.count_y;
        Row level;
        load(level, filtered[k][j]);
        level = in ? level & inside : Row{};
        const Row less = level - kToLevel;
        std::memcpy(to.levels.data() + r, &less, sizeof less);
        Int words{};
        if (in)
          words_of(matter, source.slices[at(k + 1)] + source.rows[at(j + 1)] + at(source.x), level, words);
        std::memcpy(to.matter.data() + r, &words, sizeof words);
        found |= words;
      }
    std::uint64_t parts[4];
    std::memcpy(parts, &found, sizeof parts);
    return (parts[0] | parts[1] | parts[2] | parts[3]) != 0;
  }

  // Without intensity there is no matter, so what lies beyond a row's end does not count.
  [[gnu::always_inline]] static void words_of(const MatterSource& matter, std::size_t cell, const Row& level,
                                              Int& words) {
    Row soft, other{}, warm{};
    load(soft, matter.liquid + cell);
    if (matter.obstacle != nullptr) load(other, matter.obstacle + cell);
    if (matter.heat != nullptr) load(warm, matter.heat + cell);
    const Row shares = level == 0 ? Row{} : soft | other | warm;
    if (!any(shares)) return;
    Row hard;
    load(hard, matter.solid + cell);
    Int liquid, solid;
    wide(soft, liquid);
    wide(hard, solid);
    const Int all = liquid + solid;
    quotient(255 * liquid, all, words);
    // The divisor may have 18 bits. A quotient that was rounded up is mended.
    if (matter.obstacle != nullptr) {
      Int obstacle, share;
      wide(other, obstacle);
      quotient(255 * obstacle, all + obstacle, share);
      share += share * (all + obstacle) > 255 * obstacle;
      words |= share << 16;
    }
    if (matter.heat != nullptr) {
      Row carrier;
      load(carrier, matter.carrier + cell);
      Int heat, amount, step;
      wide(warm, heat);
      wide(carrier, amount);
      quotient(heat * 256, amount, step);
      step = step > 256 ? Int{} + 256 : step;
      for (int i = 0; i < kCells; ++i) heat[i] = matter.heats[step[i]] << 8;
      words |= amount == 0 ? Int{} : heat;
    }
    Int shown;
    wide(level, shown);
    words = shown == 0 ? Int{} : words;
  }

  // A row goes to the places 3 to 10 of one brick, and its end to the places 0 to 2 of the next one.
  template <class T>
  [[gnu::always_inline]] static void scatter_rows(const T* from, T* to, T* next) {
    if (to != nullptr) std::memcpy(to + 3, from, kCells * sizeof(T));
    if (next != nullptr) std::memcpy(next, from + kCells - 3, 3 * sizeof(T));
  }
  template <class T>
  [[gnu::always_inline]] static void scatter_all(const T* from, const std::array<T*, 8>& to) {
    for (int which = 0; which < 4; ++which) {
      T *const here = to[at(2 * which)], *const next = to[at(2 * which + 1)];
      if (here == nullptr && next == nullptr) continue;
      const int first_y = (which & 1) != 0 ? kCells - 3 : 0, first_z = (which & 2) != 0 ? kCells - 3 : 0;
      const int place_y = (which & 1) != 0 ? 0 : 3, place_z = (which & 2) != 0 ? 0 : 3;
      for (int k = first_z; k < kCells; ++k)
        for (int j = first_y; j < kCells; ++j) {
          const int row = ((k - first_z + place_z) * kSide + j - first_y + place_y) * kSide;
          scatter_rows(from + (k * kCells + j) * kCells, here == nullptr ? here : here + row,
                       next == nullptr ? next : next + row);
        }
    }
  }
  template <class T>
  [[gnu::always_inline]] static bool same_rows(const T* cells, const T* target) {
    constexpr int kWords = kCells * sizeof(T) / sizeof(std::uint64_t);
    for (int k = 0; k < kCells; ++k) {
      std::uint64_t other = 0;
      for (int j = 0; j < kCells; ++j) {
        std::uint64_t a[kWords], b[kWords];
        std::memcpy(a, cells + (k * kCells + j) * kCells, sizeof a);
        std::memcpy(b, target + ((k + 3) * kSide + j + 3) * kSide + 3, sizeof b);
        for (int i = 0; i < kWords; ++i) other |= a[i] ^ b[i];
      }
      if (other != 0) return false;
    }
    return true;
  }
  static bool same(const BrickCells& cells, const BrickTargets& targets) {
    return same_rows(cells.levels.data(), targets.levels[0]) &&
           same_rows(cells.matter.data(), targets.matter[0]);
  }

  static void scatter(const BrickCells& from, const BrickTargets& to, bool with_matter) {
    scatter_all(from.levels.data(), to.levels);
    if (with_matter) scatter_all(from.matter.data(), to.matter);
  }

  struct Lanes {
    Words most, x, y, z;
  };
  [[gnu::always_inline]] static void take(Words& most, const Words& words) {
    most = words > most ? words : most;
  }
  [[gnu::always_inline]] static void apart(const Words& a, const Words& b, Words& to) {
    to = (a > b ? a : b) - (a > b ? b : a);
  }

  // A block has the places 1 to 5, or 5 to 9. Lane 0 belongs to place 1.
  static void ranges(const std::int16_t* levels, BlockRanges& to) {
    Lanes the_lanes[4] = {};
    for (int k = 0; k < 9; ++k)
      for (int j = 0; j < 9; ++j) {
        const std::int16_t* row = levels + ((k + 1) * kSide + j + 1) * kSide + 1;
        Words here, x, y, z;
        load(here, row);
        load(x, row + 1);
        load(y, row + kSide);
        load(z, row + kSide * kSide);
        here += kToLevel;
        apart(x + kToLevel, here, x);
        apart(y + kToLevel, here, y);
        apart(z + kToLevel, here, z);
        for (int half_z = k < 4 ? 0 : 1; half_z >= (k > 4 ? 1 : 0); --half_z)
          for (int half_y = j < 4 ? 0 : 1; half_y >= (j > 4 ? 1 : 0); --half_y) {
            Lanes& block = the_lanes[2 * half_z + half_y];
            take(block.most, here);
            take(block.x, x);
            if (j < 4 * half_y + 4) take(block.y, y);
            if (k < 4 * half_z + 4) take(block.z, z);
          }
      }
    for (int quarter = 0; quarter < 4; ++quarter) {
      alignas(32) Word lanes[4][16];
      std::memcpy(lanes, &the_lanes[quarter], sizeof lanes);
      for (int half_x = 0; half_x < 2; ++half_x) {
        const auto largest = [&](const Word* from, int count) {
          Word most = 0;
          for (int i = 4 * half_x; i < 4 * half_x + count; ++i) most = from[i] > most ? from[i] : most;
          return most;
        };
        const std::size_t block = at(2 * quarter + half_x);
        to.most[block] = static_cast<std::int16_t>(largest(lanes[0], 5) - kToLevel);
        to.along_x[block] = largest(lanes[1], 4);
        to.along_y[block] = largest(lanes[2], 5);
        to.along_z[block] = largest(lanes[3], 5);
      }
    }
  }
};

template <class Arch>
BrickLoops brick_loops_for() {
  using Of = BrickKernels<Arch>;
  return {Of::cells, Of::same, Of::scatter, Of::ranges};
}

}  // namespace voxmelt::render
