// Under the viscous law, the sums of runs that end at one height give their settled amounts, and what they
// show. The code treats those parts of 64 columns that have such a run. It has plain loops over lanes, for
// the compiler to vectorise.
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

#include "kernel/engine/cpu/lanes.h"
#include "kernel/engine/simd/features.h"
#include "kernel/engine/simd/kernels.h"

namespace voxmelt::simd {

// Holds the sums of runs that have ended, at most one a column.
struct alignas(64) EndedRuns {
  std::uint16_t excess_low[64], excess_high[64];  // mass - 4096 cells, signed 32-bit
  std::uint16_t first[64], last[64];              // heights of the first and the last cell
  std::uint16_t bed[64];                          // see Beds
  std::uint16_t content[4][64];  // sums of the low and of the high halves of amount x heat, 32-bit each
  std::uint64_t columns;         // columns that have a run here
  std::uint64_t ordered;         // columns whose run keeps its order
  std::uint64_t roofed;          // columns whose run is under a ceiling
  int top;                       // greatest of `last`
};
static_assert(sizeof(EndedRuns) == kSettleRecord && offsetof(EndedRuns, columns) % 64 == 0);

// Holds the settled amounts. Below the pivot a cell gets 4096, at the pivot `at`, and above it `above`.
struct alignas(64) SettledRuns {
  std::uint16_t pivot[64];  // 1 + its height
  std::uint16_t at[64], above[64];
  std::uint16_t head_low[64], head_high[64];  // 1024 + head above the grid's bottom
  std::uint16_t mobility[64], dead[64];
  std::uint16_t heat[64];                                        // heat of runs that do not keep their order
  std::uint16_t fine[64], limit[64], shown_bed[64], filled[64];  // as in Runs
  std::uint64_t ordered;  // after the arrays, so that vectors may be aligned
  std::uint64_t shut;     // columns whose run is full, under a ceiling
};
static_assert(offsetof(SettledRuns, ordered) % 64 == 0);

template <class Arch, bool kHot>
class RunData {
  using L = cpu::Lanes<Arch>;

 public:
  [[gnu::always_inline]] RunData(const Step& step)
      : flow_(step.parameters->flow),
        pace_((step.parameters->flow.viscous.mobility + step.substeps / 2) / step.substeps),
        dither_(step.dither),
        reach_(step.relaxed_reach),
        bits_(step.relaxed_bits) {}

  using Limits = state::LimitCounts<std::int64_t>;

  // Settles the runs. Other columns keep what they have. It returns the term `rounded` of the books, for runs
  // that mix, and adds to `limits`.
  [[gnu::always_inline]] std::int64_t settle(const EndedRuns& runs, SettledRuns& settled,
                                             Limits& limits) const {
    std::int64_t rounded = 0;
    for (int part = 0; part < L::kParts; ++part)
      if (L::in_part(runs.columns, part)) rounded += settle(part, runs, settled, limits);
    settled.ordered = (settled.ordered & ~runs.columns) | runs.ordered;
    settled.shut = settled.shut & ~runs.columns;
    if (runs.roofed != 0) settled.shut |= runs.roofed & full(runs);
    return rounded;
  }

 private:
  using Lanes16 = std::uint16_t[64];  // one part at a time is in use
  using Lanes32 = std::int32_t[64];

  [[gnu::always_inline]] std::int64_t settle(int part, const EndedRuns& runs, SettledRuns& settled,
                                             Limits& limits) const {
    alignas(64) Lanes32 mass, over;
    alignas(64) Lanes16 counts, mean;
    SettledRuns now;
    const int begin = part * L::kCount, end = begin + L::kCount;
    L::store(counts + begin, L::keep(L::from_bits(runs.columns, part), L::set(1)));
    for (int i = begin; i < end; ++i) {
      const int excess = std::uint32_t{runs.excess_high[i]} << 16 | runs.excess_low[i];
      const int cells = runs.last[i] - runs.first[i] + 1;
      // Lanes that are not asked for get a harmless run.
      mass[i] = counts[i] != 0 ? excess + 4096 * cells : 4096;
      over[i] = counts[i] != 0 && excess > 0 ? excess : 0;
    }
    fill(begin, mass, over, runs, now);
    const std::int64_t rounded = kHot ? mix(begin, mass, counts, runs, now, mean) : 0;
    show(begin, mass, over, counts, runs, mean, now, limits);
    const auto asked = L::from_bits(runs.columns, part);
    const auto keep = [&](const Lanes16& value, Lanes16& kept) VOXMELT_LAMBDA {
      L::store(kept + begin, L::select(asked, L::load(value + begin), L::load(kept + begin)));
    };
    keep(now.pivot, settled.pivot);
    keep(now.at, settled.at);
    keep(now.above, settled.above);
    keep(now.head_low, settled.head_low);
    keep(now.head_high, settled.head_high);
    keep(now.mobility, settled.mobility);
    keep(now.dead, settled.dead);
    keep(now.fine, settled.fine);
    keep(now.limit, settled.limit);
    keep(now.shown_bed, settled.shown_bed);
    keep(now.filled, settled.filled);
    if constexpr (kHot) keep(now.heat, settled.heat);
    return rounded;
  }

  // Returns the columns whose run is full, but for 1/64 of a cell.
  [[gnu::always_inline]] static std::uint64_t full(const EndedRuns& runs) {
    std::uint64_t columns = 0;
    for (int part = 0; part < L::kParts; ++part) {
      if (!L::in_part(runs.roofed, part)) continue;
      const auto at = [&](const Lanes16& field) VOXMELT_LAMBDA { return L::load(field + part * L::kCount); };
      // -64..64 has no other upper half than 0 or -1.
      const auto up = at(runs.excess_high), low = at(runs.excess_low);
      const auto above = L::less(low, L::set(65)), below = L::less(L::set(0xFFFF - 64), low);
      const std::uint64_t over = L::to_bits(L::equal(up, L::zero())) & L::to_bits(above);
      const std::uint64_t under = L::to_bits(L::equal(up, L::set(0xFFFF))) & L::to_bits(below);
      columns |= (over | under) << (part * L::kCount);
    }
    return columns;
  }

  [[gnu::always_inline]] static void fill(int begin, const Lanes32& mass, const Lanes32& over,
                                          const EndedRuns& runs, SettledRuns& now) {
    const int end = begin + L::kCount;
    int any = 0;
    for (int i = begin; i < end; ++i) {
      const int below = (mass[i] - 1) >> 12;
      now.pivot[i] = static_cast<std::uint16_t>(runs.first[i] + below + 1);
      now.at[i] = static_cast<std::uint16_t>(mass[i] - 4096 * below);
      now.above[i] = 0;
      any |= over[i];
    }
    if (any == 0) return;
    // Under a ceiling, liquid that does not fit is stacked from the top down.
    for (int i = begin; i < end; ++i) {
      if (over[i] == 0) continue;
      constexpr int kHeadroom = 65535 - 4096;
      const int filled = over[i] / kHeadroom;
      now.pivot[i] = static_cast<std::uint16_t>(runs.last[i] - filled + 1);
      now.at[i] = static_cast<std::uint16_t>(4096 + over[i] - kHeadroom * filled);
      now.above[i] = 65535;
    }
  }

  // Computes the mean heat, and one heat for a whole run if the order is not kept. All numbers are below 2^53
  // and so exact in double. A quotient is rounded to the next whole number only if it is one.
  [[gnu::always_inline]] std::int64_t mix(int begin, const Lanes32& mass, const Lanes16& counts,
                                          const EndedRuns& runs, SettledRuns& now, Lanes16& mean) const {
    const int end = begin + L::kCount;
    alignas(64) double content[64];
    for (int i = begin; i < end; ++i) {
      const std::uint32_t asked = 0u - counts[i];  // a mask: a branch would keep the loop from lanes
      const std::uint32_t low = (std::uint32_t{runs.content[1][i]} << 16 | runs.content[0][i]) & asked;
      const std::uint32_t high = (std::uint32_t{runs.content[3][i]} << 16 | runs.content[2][i]) & asked;
      content[i] = 65536.0 * static_cast<std::int32_t>(high) + static_cast<std::int32_t>(low);
      mean[i] = static_cast<std::uint16_t>(static_cast<int>(content[i] / mass[i]));
    }
    if (!L::in_part(runs.columns & ~runs.ordered, begin / L::kCount)) return 0;
    std::int64_t rounded = 0;
    for (int i = begin; i < end; ++i) {
      const double m = mass[i];
      const int offset = static_cast<int>(m * dither_ * (1.0 / 65536));
      const int heat = static_cast<int>((content[i] + offset) / m);
      now.heat[i] = static_cast<std::uint16_t>(heat);
      if ((runs.columns & ~runs.ordered) >> i & 1) rounded += static_cast<int>(m * heat - content[i]);
    }
    return rounded;
  }

  // Computes head, mobility and dead zone.
  [[gnu::always_inline]] void show(int begin, const Lanes32& mass, const Lanes32& over, const Lanes16& counts,
                                   const EndedRuns& runs, const Lanes16& mean, SettledRuns& now,
                                   Limits& limits) const {
    const int end = begin + L::kCount;
    const int stiffness = flow_.viscous.stiffness, yield = flow_.viscous.yield;
    alignas(64) Lanes32 mobility;
    for (int i = begin; i < end; ++i) {
      const int head = 1024 + 512 * runs.first[i] + ((runs.bed[i] - 4096) >> 3) + (mass[i] >> 3) +
                       (stiffness - 1) * (over[i] >> 3);
      now.head_low[i] = static_cast<std::uint16_t>(head & 0xFFFF);
      now.head_high[i] = static_cast<std::uint16_t>(head >> 16);
      now.shown_bed[i] = static_cast<std::uint16_t>(16 * runs.first[i] + (runs.bed[i] >> 8) - 15);

      // Here depth < 2^24. The float quotient of whole numbers is less than one off if it is below 131072.
      const int depth = mass[i] < 16 ? 1 : mass[i] >> 4, sum = 2 * yield + depth / 2;
      int dead = static_cast<int>(static_cast<float>(sum) / static_cast<float>(depth));
      const int rest = sum - dead * depth;
      dead += rest < 0 ? -1 : rest >= depth ? 1 : 0;
      dead = dead < 1 ? 1 : dead;
      now.dead[i] = static_cast<std::uint16_t>(dead < 65535 ? dead : 65535);
    }
    if (kBuilt.thermal && flow_.thermal_viscosity)
      move<true>(begin, mass, mean, mobility);
    else
      move<false>(begin, mass, mean, mobility);

    int cells = 0, limited_cells = 0, low = 0, limited_low = 0, high = 0, limited_high = 0;
    for (int i = begin; i < end; ++i) {
      // The quotients are of whole numbers below 2^14. A float has the right whole part for them.
      const int whole = static_cast<int>(13107.f / static_cast<float>((mass[i] >> 12) + 1));
      const int stiff = static_cast<int>(static_cast<float>(whole) / static_cast<float>(stiffness));
      const int limit = (over[i] > 0 ? stiff : whole) * reach_ >> bits_, most = limit < 1 ? 1 : limit;
      const int range = (1 << (22 + bits_)) - 1, shown = mobility[i] < range ? mobility[i] : range;
      now.limit[i] = static_cast<std::uint16_t>(most);
      now.mobility[i] = static_cast<std::uint16_t>(shown >> (8 + bits_));
      now.fine[i] = static_cast<std::uint16_t>(shown << (8 - bits_) & 0xFFFF);

      const int one = counts[i], limited = mobility[i] > most << (8 + bits_) ? one : 0;
      const int held = over[i] > 0 ? runs.last[i] - runs.first[i] + 1 : ((mass[i] - 1) >> 12) + 1;
      now.filled[i] = static_cast<std::uint16_t>(held);
      cells += one * held;
      limited_cells += limited * held;
      low += one * (mass[i] & 0xFFFF);
      limited_low += limited * (mass[i] & 0xFFFF);
      high += one * (mass[i] >> 16);
      limited_high += limited * (mass[i] >> 16);
    }
    limits.add(Limits{cells, limited_cells, (std::int64_t{high} << 16) + low,
                      (std::int64_t{limited_high} << 16) + limited_low});
  }

  // Computes mobilities, cut at 2^30, above every limit. (p q + 2^23) >> 24 has up to 40 bits. So p is
  // parted in two of 18 bits, and all numbers are whole and exact in double.
  template <bool kThermal>
  [[gnu::always_inline]] void move(int begin, const Lanes32& mass, const Lanes16& mean,
                                   Lanes32& mobility) const {
    const int end = begin + L::kCount;
    const double high = static_cast<double>(pace_ >> 18), low = static_cast<double>(pace_ & 0x3FFFF);
    alignas(64) double power[64];
    if constexpr (kThermal) powers(begin, mean, power);
    for (int i = begin; i < end; ++i) {
      const double depth = mass[i] < 262144 ? mass[i] : 262144;
      const double square = static_cast<int>(depth * depth * (1.0 / 256));
      const int carried = static_cast<int>((low * square + 8388608.0) * (1.0 / 262144));
      double free = (high * square + carried) * (1.0 / 64);
      if constexpr (kThermal) free = std::floor(free) * power[i];
      mobility[i] = static_cast<int>(free < 1073741824.0 ? free : 1073741824.0);
    }
  }

  // Computes e 2^(n - 12) by the mean heat. A double of 13 bits times a power of two is exact, and so is its
  // product with a mobility of 40 bits.
  [[gnu::always_inline]] void powers(int begin, const Lanes16& mean, double (&power)[64]) const {
    const int end = begin + L::kCount;
    const int reference = flow_.mobility_reference, rate = flow_.mobility_rate;
    for (int i = begin; i < end; ++i) {
      const int octaves = ((kHot ? mean[i] : 0) - reference) * rate >> 6;
      const int high = octaves < (1 << 19) - 1 ? octaves : (1 << 19) - 1;
      const int x = high > -(1 << 21) ? high : -(1 << 21);
      const std::uint32_t f = x & 0xFFFF;
      const int e = static_cast<int>(4096 + (f * (43057 + (22479 * f >> 16)) >> 20));
      const std::uint64_t exponent = (x >> 16) - 12 + 1023;  // of a double
      power[i] = e * std::bit_cast<double>(exponent << 52);
    }
  }

  const rule::Flow& flow_;
  const std::uint64_t pace_;  // mobility parameter of a sub-step
  const std::uint32_t dither_;
  const int reach_, bits_;  // of a relaxation
};

}  // namespace voxmelt::simd
