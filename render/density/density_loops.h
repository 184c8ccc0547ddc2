// The loops are written once over groups of eight cells, in the vector types that gcc and clang have for any
// processor. Everything is a template over the instruction set, so that the linker cannot take a function of
// one for another's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernel/engine/cpu/independent_loop.h"
#include "render/density/loops.h"

namespace voxmelt::render {

// Holds the code of one instruction set, which must not be shared with others.
template <class Arch>
struct DensityLoops {
  static constexpr int kGroup = 8;
  static constexpr int kRows = kBrickSide * kBrickSide;
  using U16 [[gnu::vector_size(16)]] = std::uint16_t;
  using I32 [[gnu::vector_size(32)]] = std::int32_t;
  using U32 [[gnu::vector_size(32)]] = std::uint32_t;
  using F32 [[gnu::vector_size(32)]] = float;

  template <class V, class T>
  [[gnu::always_inline]] static void load(V& to, const T* from) {
    static_assert(sizeof(V) == kGroup * sizeof(T));
    std::memcpy(&to, from, sizeof(V));
  }
  template <class V, class T>
  [[gnu::always_inline]] static void store(const V& from, T* to) {
    std::memcpy(to, &from, sizeof(V));
  }
  // Converts element by element. g++ 12 makes one instruction of this, but five of a conversion of the
  // vector.
  template <class To>
  [[gnu::always_inline]] static void load_as(To& to, const std::uint16_t* p) {
    to = To{p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]};
  }

  // Loads the first `count` cells at most. The others become zeros, and all of them if `cells` is null.
  [[gnu::always_inline]] static void load_some(U16& to, const std::uint16_t* cells, int count) {
    to = U16{};
    if (cells == nullptr) return;
    if (count >= kGroup)
      load(to, cells);
    else
      for (int lane = 0; lane < count; ++lane) to[lane] = cells[lane];
  }

  // Stores the first `count` cells, at most a group.
  [[gnu::always_inline]] static void store_some(const U16& from, std::uint16_t* cells, int count) {
    if (count >= kGroup)
      store(from, cells);
    else
      std::memcpy(cells, &from, sizeof(std::uint16_t) * count);
  }

  [[gnu::always_inline]] static U16 lanes_of(std::uint64_t bits) {
    const U16 own{1, 2, 4, 8, 16, 32, 64, 128};
    return ((U16{} + static_cast<std::uint16_t>(bits & 0xff)) & own) == own;
  }

  template <class T>
  [[gnu::always_inline]] static T* at(const Block<T>& block, int j, int k) {
    return block.cells + static_cast<std::size_t>(k) * block.slice + static_cast<std::size_t>(j) * block.row;
  }

  [[gnu::always_inline]] static bool any(const U16& lanes) {
    std::uint64_t halves[2];
    std::memcpy(halves, &lanes, sizeof halves);
    return (halves[0] | halves[1]) != 0;
  }

  // Holds the masks of a brick's rows, and of all of it.
  struct Rows {
    std::uint64_t solids[kRows], liquids[kRows], any_solid = 0, any_liquid = 0;
  };
  // Reads the masks. The kept values lie far apart in memory, so they are prefetched here.
  enum class Carried { nothing, heat, tone };  // what the channel of heat holds
  template <Carried kCarried>
  [[gnu::always_inline]] static void take_rows(const MatterBrick& brick, Rows& rows) {
    for (int k = 0; k < brick.z; ++k)
      for (int j = 0; j < brick.y; ++j) {
        const std::size_t word = k * brick.mask_slice + j * brick.mask_row;
        const int r = k * kBrickSide + j;
        rows.any_solid |= rows.solids[r] = brick.solid[word] >> brick.shift & 0xff;
        rows.any_liquid |= rows.liquids[r] = brick.liquid[word] >> brick.shift & 0xff;
        if ((rows.solids[r] | rows.liquids[r]) != 0) __builtin_prefetch(at(brick.amount, j, k));
        if (brick.kept_solid) __builtin_prefetch(at(brick.to_solid, j, k));
        if (brick.kept_liquid) __builtin_prefetch(at(brick.to_liquid, j, k));
        if (kCarried == Carried::heat && rows.liquids[r] != 0) __builtin_prefetch(at(brick.heat, j, k));
        if (kCarried != Carried::nothing && brick.kept_heat) __builtin_prefetch(at(brick.to_heat, j, k));
      }
  }

  // Collects the changes in a channel. Most rows are unchanged, and they are only compared.
  template <bool kWhole>
  struct ChannelChange {
    U16 lanes{};
    unsigned y = 0, z = 0;

    [[gnu::always_inline]] void take(const U16& fresh, std::uint16_t* kept, int count, int j, int k) {
      U16 old;
      if constexpr (kWhole)
        load(old, kept);
      else
        load_some(old, kept, count);
      const U16 change = fresh ^ old;
      if (!any(change)) return;
      if constexpr (kWhole)
        store(fresh, kept);
      else
        store_some(fresh, kept, count);
      lanes |= change;
      y |= 1u << j;
      z |= 1u << k;
    }
    [[gnu::always_inline]] BrickPart part() const {
      unsigned x = 0;
      for (int lane = 0; lane < kGroup; ++lane) x |= (lanes[lane] != 0 ? 1u : 0u) << lane;
      return {static_cast<std::uint8_t>(x), static_cast<std::uint8_t>(y), static_cast<std::uint8_t>(z)};
    }
  };

  [[gnu::always_inline]] static void heat_of(const U16& liquid, const std::uint16_t* temperatures,
                                             U16& heat) {
    U32 wide, temperature;
    load_as(temperature, temperatures);
    wide = __builtin_convertvector(liquid, U32);
    heat = __builtin_convertvector(wide * temperature >> 16, U16);
  }

  // Computes solid * tone / 256, rounded up. So the tone is found again by a quotient that is rounded down.
  [[gnu::always_inline]] static void tone_of(const U16& solid, const MatterBrick& brick, int j, int k,
                                             U16& heat) {
    U32 wide, tone;
    for (int lane = 0; lane < kGroup; ++lane)
      tone[lane] =
          brick.tones[brick.material.cells == nullptr || solid[lane] == 0 ? 0
                                                                          : at(brick.material, j, k)[lane]];
    wide = __builtin_convertvector(solid, U32);
    heat = __builtin_convertvector((wide * tone + 255) >> 8, U16);
  }

  template <bool kWhole, Carried kCarried>
  static MatterFound matter_of(const MatterBrick& brick) {
    Rows rows;
    take_rows<kCarried>(brick, rows);
    ChannelChange<kWhole> of_solid, of_liquid, of_heat;
    const bool hard = rows.any_solid != 0 || brick.kept_solid,
               wet = rows.any_liquid != 0 || brick.kept_liquid,
               warm =
                   kCarried != Carried::nothing &&
                   ((kCarried == Carried::tone ? rows.any_solid : rows.any_liquid) != 0 || brick.kept_heat);
    for (int k = 0; (hard || wet || warm) && k < brick.z; ++k)
      for (int j = 0; j < brick.y; ++j) {
        const int r = k * kBrickSide + j;
        U16 value{};
        if ((rows.solids[r] | rows.liquids[r]) != 0) {
          load(value, at(brick.amount, j, k));
          value = value > 4096 ? U16{} + 4096 : value;
          value = (value << 4) - ((value + 15) >> 4);  // 255 a / 16, rounded down
        }
        const U16 solid = value & lanes_of(rows.solids[r]);
        if (hard) of_solid.take(solid, at(brick.to_solid, j, k), brick.x, j, k);
        const U16 liquid = value & lanes_of(rows.liquids[r]);
        if (wet) of_liquid.take(liquid, at(brick.to_liquid, j, k), brick.x, j, k);
        if (!warm) continue;
        U16 heat{};
        if (kCarried == Carried::heat && rows.liquids[r] != 0) heat_of(liquid, at(brick.heat, j, k), heat);
        if (kCarried == Carried::tone && rows.solids[r] != 0) tone_of(solid, brick, j, k, heat);
        of_heat.take(heat, at(brick.to_heat, j, k), brick.x, j, k);
      }
    return {of_solid.part(), of_liquid.part(), of_heat.part()};
  }

  template <Carried kCarried>
  static MatterFound matter_carrying(const MatterBrick& brick) {
    return brick.x == kGroup ? matter_of<true, kCarried>(brick) : matter_of<false, kCarried>(brick);
  }
  static MatterFound matter(const MatterBrick& brick) {
    if (brick.tones != nullptr) return matter_carrying<Carried::tone>(brick);
    return brick.with_heat ? matter_carrying<Carried::heat>(brick) : matter_carrying<Carried::nothing>(brick);
  }

  // Computes (a + 2 b + c) / 4 to nearest, with halves upwards. It does not leave 16 bits, because the mean
  // of a and c is rounded down, and the mean of that and b up.
  [[gnu::always_inline]] static void average(const std::uint16_t* a, const std::uint16_t* b,
                                             const std::uint16_t* c, int count, std::uint16_t* to) {
    VOXMELT_INDEPENDENT
    for (int i = 0; i < count; ++i) {
      const auto outer = static_cast<std::uint16_t>((a[i] & c[i]) + ((a[i] ^ c[i]) >> 1));
      to[i] = static_cast<std::uint16_t>((outer + b[i] + 1) >> 1);
    }
  }

  // Filters along z into one half of `room`, from there along y into the other half, and from there along x.
  static void low_pass(Block<const std::uint16_t> from, Block<std::uint16_t> to, int x, int y, int z,
                       std::uint16_t* room) {
    const int wide = (x + 2 + kLanes - 1) / kLanes * kLanes, own = (x + kLanes - 1) / kLanes * kLanes;
    const std::size_t step = wide + kLanes;
    std::uint16_t* const other = room + step * (y + 2);
    for (int k = 0; k < z; ++k) {
      for (int j = 0; j < y + 2; ++j) {
        const std::uint16_t* row = from.cells + k * from.slice + j * from.row;
        average(row, row + from.slice, row + 2 * from.slice, wide, room + j * step);
      }
      for (int j = 0; j < y; ++j) {
        const std::uint16_t* row = room + j * step;
        average(row, row + step, row + 2 * step, wide, other + j * step);
      }
      for (int j = 0; j < y; ++j) {
        const std::uint16_t* row = other + j * step;
        average(row, row + 1, row + 2, own, to.cells + k * to.slice + j * to.row);
      }
    }
  }

  // Computes the weights. Directly above a solid, the liquid's share is about 0.35 with a film of half a
  // cell, and 0.9 with one of two cells. The quotient is below 2^7 and its numerator below 2^23. In single
  // precision, rounded down, it is exact.
  static void weights(const std::uint16_t* liquid, const std::uint16_t* solid, const std::uint16_t* obstacle,
                      int count, std::uint16_t* weights) {
    for (int i = 0; i < count; i += kGroup) {
      U16 cells;
      I32 soft, hard, other;
      load_some(cells, liquid + i, count - i);
      soft = __builtin_convertvector(cells, I32);
      load_some(cells, solid + i, count - i);
      hard = __builtin_convertvector(cells, I32);
      load_some(cells, obstacle == nullptr ? nullptr : obstacle + i, count - i);
      other = __builtin_convertvector(cells, I32);
      const I32 all = (soft + hard + other + 3) >> 2;
      I32 over = 5 * ((soft + 3) >> 2) - 2 * all;
      over = over < 0 ? I32{} : over;
      over = over > 2 * all ? 2 * all : over;
      const I32 divisor = all < 1 ? I32{} + 1 : all;
      const I32 t = __builtin_convertvector(
          __builtin_convertvector(64 * over, F32) / __builtin_convertvector(divisor, F32), I32);
      store(__builtin_convertvector(t * t * (384 - 2 * t) >> 13, U16), weights + i);
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

  // Returns how much of a difference between neighbours counts. All of it counts up to one cell, and nothing
  // from two.
  [[gnu::always_inline]] static std::int32_t share(std::int32_t difference) {
    const std::int32_t size = (difference < 0 ? -difference : difference) >> 4;
    const std::int32_t left = 8192 - size;
    return left < 0 ? 0 : left > 4096 ? 4096 : left;
  }
  // Fits 32 bits. If a share is not 0, both differences are below 2^17.
  [[gnu::always_inline]] static std::int32_t bend(std::int32_t before, std::int32_t here,
                                                  std::int32_t after) {
    const std::int32_t down = before - here, up = after - here;
    const std::int32_t one = share(down), two = share(up);
    return (down + up) * (one < two ? one : two) >> 12;
  }
  static void smooth_levels(const LevelRows& from, int count, std::int32_t* to) {
    const std::int32_t *low = from.low, *mid = from.here, *high = from.high;
    VOXMELT_INDEPENDENT
    for (int x = 0; x < count; ++x) {
      const std::int32_t here = mid[x];
      const std::int32_t straight = bend(mid[x - 1], here, mid[x + 1]) + bend(low[x], here, high[x]);
      const std::int32_t diagonal = bend(low[x - 1], here, high[x + 1]) + bend(high[x - 1], here, low[x + 1]);
      to[x] = here + ((2 * straight + diagonal) >> 4);
    }
  }
};

template <class Arch>
Loops loops_for() {
  using Of = DensityLoops<Arch>;
  return {Of::matter, Of::low_pass, Of::weights, Of::mix, Of::smooth_levels};
}

}  // namespace voxmelt::render
