// The loops of the light are written once, as plain loops over 16-bit numbers, which compilers turn into
// vectors. Everything is a template over the instruction set, so that the linker cannot take a function of
// one for another's.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "kernel/engine/cpu/independent_loop.h"
#include "render/light/light_loops.h"

namespace voxmelt::render {

template <class Arch>
struct LightSweeps {
  using Byte = std::uint8_t;
  using Word = std::uint16_t;
  using Bytes [[gnu::vector_size(16)]] = std::uint8_t;
  using Words [[gnu::vector_size(32)]] = std::uint16_t;
  using Eight [[gnu::vector_size(16)]] = std::uint16_t;
  using Float [[gnu::vector_size(32)]] = float;
  using Int [[gnu::vector_size(32)]] = std::int32_t;
  static constexpr int kGroup = 8;

  [[gnu::always_inline]] static Word word(int value) { return static_cast<Word>(value); }

  // Returns the loss of a density, 0 .. 256.
  [[gnu::always_inline]] static Word loss_of(Byte density) {
    const Word over = density > 12 ? word(density - 12) : Word{0};
    const Word loss = word(word(over * 3) >> 1);
    return loss > 256 ? Word{256} : loss;
  }
  [[gnu::always_inline]] static Word passed(Word arrived, Word loss) {
    return word(word(arrived * word(256 - loss) + 128) >> 8);
  }
  [[gnu::always_inline]] static Word spread(Word a, Word b, Word c, Word d, Word e) {
    return word(word(a + e + 2 * word(b + c + d) + 4) >> 3);
  }
  [[gnu::always_inline]] static Word softer(Word a, Word b, Word c) {
    return word(word(a + 30 * b + c + 16) >> 5);
  }
  // Blends numbers of at most 255.
  [[gnu::always_inline]] static Word blended(Word a, Word b, Word weight) {
    return word(word(a * word(256 - weight) + b * weight + 128) >> 8);
  }
  // Blends numbers of at most 256. The sum of the products may have 17 bits, so its half is taken first. A
  // product with 256 may have 17 bits, too.
  [[gnu::always_inline]] static Word blended_losses(Word a, Word b, Word weight) {
    if (weight == 0) return a;
    const Word p = word(a * word(256 - weight)), q = word(b * weight);
    const Word half = word((p & q) + (word(p ^ q) >> 1));
    return word(word(half + 64) >> 7);
  }

  // Sums over the cells of each cell of light, and shifts the sums. take(index, count, sums) adds up to eight
  // cells of a row.
  template <class Take>
  [[gnu::always_inline]] static void each_cell(const LightBlock& block, int shift, Byte* to,
                                               const Take& take) {
    const int side = 1 << block.shift;
    const auto end = [](int at, int most) { return at < most ? at : most; };
    for (int z = 0; z < block.z; z += side)
      for (int y = 0; y < block.y; y += side) {
        Byte* const row = to + static_cast<std::size_t>(z >> block.shift) * block.to_slice +
                          static_cast<std::size_t>(y >> block.shift) * block.to_row;
        std::uint32_t sum = 0;  // sum for a cell of light wider than a group
        for (int x = 0; x < block.x; x += kGroup) {
          std::uint32_t sums[kGroup] = {};
          for (int k = z; k < end(z + side, block.z); ++k)
            for (int j = y; j < end(y + side, block.y); ++j)
              take(k * block.slice + j * block.row + x, block.x - x, sums);
          for (int i = 0; i < kGroup; ++i) {
            sum += sums[i];
            if ((x + i + 1) % side != 0 && x + i + 1 != block.x) continue;
            row[(x + i) >> block.shift] = static_cast<Byte>(sum >> shift);
            sum = 0;
            if (x + i + 1 == block.x) break;
          }
        }
      }
  }

  // Loads eight cells at most. The others become zeros.
  [[gnu::always_inline]] static void load_some(const Word* from, int count, Word (&to)[kGroup]) {
    if (count >= kGroup) {
      std::memcpy(to, from, sizeof to);
    } else {
      for (int i = 0; i < kGroup; ++i) to[i] = i < count ? from[i] : Word{0};
    }
  }

  static void density(const LightBlock& block, Byte* to) {
    each_cell(
        block, 3 * block.shift + 8,
        to, [&](std::size_t at, int count, std::uint32_t(&sums)[kGroup]) __attribute__((always_inline)) {
          Word cells[kGroup];
          load_some(block.intensity + at, count, cells);
          for (int i = 0; i < kGroup; ++i) sums[i] += cells[i];
        });
  }

  // Sums the emission by the temperature in 256 steps. The quotient is below 2^8 and its numerator below
  // 2^24. In single precision it is never rounded up to a whole number.
  static void emission(const LightBlock& block, Byte* to) {
    each_cell(
        block, 3 * block.shift,
        to, [&](std::size_t at, int count, std::uint32_t(&sums)[kGroup]) __attribute__((always_inline)) {
          Word cells[kGroup];
          load_some(block.liquid + at, count, cells);
          std::uint64_t any[2];
          std::memcpy(any, cells, sizeof any);
          if ((any[0] | any[1]) == 0) return;
          Eight eight;
          std::memcpy(&eight, cells, sizeof eight);
          const Int liquid = __builtin_convertvector(eight, Int);
          load_some(block.heat + at, count, cells);
          std::memcpy(&eight, cells, sizeof eight);
          const Int warm = __builtin_convertvector(eight, Int) * 256,
                    divisor = liquid < 1 ? Int{} + 1 : liquid;
          const Float quotient =
              __builtin_convertvector(warm, Float) / __builtin_convertvector(divisor, Float);
          Int step = __builtin_convertvector(quotient, Int);
          step = step > 256 ? Int{} + 256 : step;
          Int sent;
          for (int i = 0; i < kGroup; ++i) sent[i] = block.emission[step[i]];
          Int sum;
          std::memcpy(&sum, sums, sizeof sum);
          sum += (liquid * sent) >> 16;
          std::memcpy(sums, &sum, sizeof sum);
        });
  }

  template <class V, class T>
  [[gnu::always_inline]] static void load(V& to, const T* from) {
    std::memcpy(&to, from, sizeof(V));
  }
  template <class V, class T>
  [[gnu::always_inline]] static void store(const V& from, T* to) {
    std::memcpy(to, &from, sizeof(V));
  }
  // Loads element by element, which g++ 12 turns into one instruction.
  [[gnu::always_inline]] static void load_bytes(Words& to, const Byte* p) {
    to = Words{p[0], p[1], p[2],  p[3],  p[4],  p[5],  p[6],  p[7],
               p[8], p[9], p[10], p[11], p[12], p[13], p[14], p[15]};
  }
  [[gnu::always_inline]] static void spread_of(const Words& a, const Words& b, const Words& c, const Words& d,
                                               const Words& e, Words& to) {
    const Words inner = b + c + d;
    to = (a + e + inner + inner + 4) >> 3;
  }

  // Computes the light that left a row of the slice before, spread along it.
  template <bool kGlow>
  [[gnu::always_inline]] static void leave(const SideSlice& slice, int v, Word* left, Word* along) {
    constexpr Word kOutside = kGlow ? 0 : 255;
    const int count = light_row(slice.u);
    const std::size_t at = v * slice.row_step;
    const Byte *before = slice.before + at, *density = slice.density + at;
    for (int i = 0; i < count; i += kLightLanes) {
      Words arrived, thick;
      load_bytes(arrived, before + i);
      load_bytes(thick, density + i);
      thick = thick > 12 ? thick - 12 : Words{};
      thick = (thick * 3) >> 1;
      thick = thick > 256 ? Words{} + 256 : thick;
      Words gone = (arrived * (256 - thick) + 128) >> 8;
      if constexpr (kGlow) {
        Words sent;
        load_bytes(sent, slice.emission + at + i);
        gone += sent;
        gone = gone > 255 ? Words{} + 255 : gone;
      }
      store(gone, left + i);
    }
    left[-2] = left[-1] = left[slice.u] = left[slice.u + 1] = kOutside;
    for (int i = 0; i < count; i += kLightLanes) {
      Words a, b, c, d, e;
      load(a, left + i - 2);
      load(b, left + i - 1);
      load(c, left + i);
      load(d, left + i + 1);
      load(e, left + i + 2);
      spread_of(a, b, c, d, e, a);
      store(a, along + i);
    }
  }

  template <bool kGlow>
  static void side_of(const SideSlice& slice) {
    constexpr Word kOutside = kGlow ? 0 : 255;
    const int count = light_row(slice.u);
    const std::size_t pitch = slice.row + kLightLanes;
    Word *left = slice.room + 8, *along = slice.room + pitch;
    const auto row = [&](int v) { return along + (v - slice.low + 2) * pitch; };
    for (int v = slice.low - 2; v < slice.high + 2; ++v) {
      Word* const to = row(v);
      if (v >= 0 && v < slice.v)
        leave<kGlow>(slice, v, left, to);
      else
        for (int i = 0; i < count; ++i) to[i] = kOutside;
    }
    for (int v = slice.low; v < slice.high; ++v) {
      const Word* const first = row(v - 2);
      Byte* const to = slice.to + v * slice.row_step;
      Bytes other{};
      for (int i = 0; i < count; i += kLightLanes) {
        Words a, b, c, d, e;
        load(a, first + i);
        load(b, first + i + pitch);
        load(c, first + i + 2 * pitch);
        load(d, first + i + 3 * pitch);
        load(e, first + i + 4 * pitch);
        spread_of(a, b, c, d, e, a);
        if constexpr (kGlow)
          a -= (a + 8) >> 4;
        else
          a += (262 - a) >> 3;
        Bytes old;
        load(old, to + i);
        const Bytes fresh = __builtin_convertvector(a, Bytes);
        other |= fresh ^ old;
        store(fresh, to + i);
      }
      std::uint64_t any[2];
      std::memcpy(any, &other, sizeof any);
      slice.changed[v] = (any[0] | any[1]) != 0 ? 1 : 0;
    }
  }
  static void side(const SideSlice& slice) {
    if (slice.emission != nullptr)
      side_of<true>(slice);
    else
      side_of<false>(slice);
  }

  static void lamp(const LampSlice& slice) {
    const int count = light_row(slice.u), window = light_row(slice.u + 1);
    const Word part_u = word(slice.part_u), part_v = word(slice.part_v);
    const auto ray = [&](Word* rays, int a, int b) {
      return rays + (b + 1) * slice.ray_row + static_cast<std::size_t>(a + 1);
    };
    // The light arrives.
    for (int v = 0; v < slice.v; ++v) {
      const Word *low = ray(slice.rays, slice.at_u, slice.at_v + v), *high = low + slice.ray_row;
      Byte* const to = slice.to + v * slice.row_step;
      Byte other = 0;
      VOXMELT_INDEPENDENT
      for (int i = 0; i < count; ++i) {
        const Byte fresh = static_cast<Byte>(
            blended(blended(low[i], low[i + 1], part_u), blended(high[i], high[i + 1], part_u), part_v));
        other = static_cast<Byte>(other | (fresh ^ to[i]));
        to[i] = fresh;
      }
      slice.changed[v] = other != 0 ? 1 : 0;
    }
    // Light is lost in row v between its cells. A row of nothing lies before the first and behind the last.
    const auto losses = [&](int v) { return slice.losses + static_cast<std::size_t>(v + 1) * slice.ray_row; };
    std::memset(losses(-1), 0, slice.ray_row * sizeof(Word));
    std::memset(losses(slice.v), 0, slice.ray_row * sizeof(Word));
    Word* const own = slice.room + 8;
    for (int v = 0; v < slice.v; ++v) {
      const Byte* density = slice.density + v * slice.row_step;
      Word* const to = losses(v);
      VOXMELT_INDEPENDENT
      for (int i = 0; i < count; ++i) own[i] = loss_of(density[i]);
      own[-1] = 0;
      for (int i = slice.u; i < window + 1; ++i) own[i] = 0;
      VOXMELT_INDEPENDENT
      for (int i = 0; i < window; ++i) to[i] = blended_losses(own[i], own[i - 1], part_u);
    }
    for (int v = 0; v <= slice.v; ++v) {
      const Word *here = losses(v), *before = losses(v - 1);
      Word* const to = ray(slice.rays, slice.at_u, slice.at_v + v);
      VOXMELT_INDEPENDENT
      for (int i = 0; i < window; ++i) to[i] = passed(to[i], blended_losses(here[i], before[i], part_v));
    }
    // Rays are softened along u into the room, and back along v.
    const int wide = light_row(slice.count_u);
    for (int b = slice.low_v; b < slice.high_v; ++b) {
      const Word* from = ray(slice.rays, 0, b);
      Word* const to = ray(slice.room, 0, b);
      VOXMELT_INDEPENDENT
      for (int i = 0; i < wide; ++i) to[i] = softer(from[i - 1], from[i], from[i + 1]);
    }
    for (const int b : {slice.low_v - 1, slice.high_v})
      for (int i = 0; i < wide; ++i) ray(slice.room, 0, b)[i] = 255;
    for (int b = slice.low_v; b < slice.high_v; ++b) {
      const Word *from = ray(slice.room, 0, b), *before = from - slice.ray_row, *after = from + slice.ray_row;
      Word* const to = ray(slice.rays, 0, b);
      VOXMELT_INDEPENDENT
      for (int i = 0; i < wide; ++i) to[i] = softer(before[i], from[i], after[i]);
      for (int i = slice.count_u; i < wide + 1; ++i) to[i] = 255;
    }
  }

  template <int kStep>
  [[gnu::always_inline]] static void shuffle_all(Bytes (&rows)[2 * kStep]) {
    Bytes next[2 * kStep];
    for (int i = 0; i < kStep; ++i) {
      next[2 * i] = __builtin_shufflevector(rows[i], rows[i + kStep], 0, 16, 1, 17, 2, 18, 3, 19, 4, 20, 5,
                                            21, 6, 22, 7, 23);
      next[2 * i + 1] = __builtin_shufflevector(rows[i], rows[i + kStep], 8, 24, 9, 25, 10, 26, 11, 27, 12,
                                                28, 13, 29, 14, 30, 15, 31);
    }
    for (int i = 0; i < 2 * kStep; ++i) rows[i] = next[i];
  }

  static void transpose(const Byte* from, std::size_t from_row, int x, int y, Byte* to, std::size_t to_row,
                        Byte* changed) {
    for (int j = 0; j < y; j += kLightLanes)
      for (int i = 0; i < x; i += kLightLanes) {
        Bytes block[16];
        for (int r = 0; r < 16; ++r) {
          if (i + r < x)
            std::memcpy(&block[r], from + (i + r) * from_row + j, sizeof(Bytes));
          else
            block[r] = Bytes{};
        }
        for (int round = 0; round < 4; ++round) shuffle_all<8>(block);
        for (int r = 0; r < 16 && j + r < y; ++r) {
          Byte* const at = to + (j + r) * to_row + i;
          std::uint64_t old[2], fresh[2];
          std::memcpy(old, at, sizeof old);
          std::memcpy(fresh, &block[r], sizeof fresh);
          if (((old[0] ^ fresh[0]) | (old[1] ^ fresh[1])) == 0) continue;
          changed[j + r] = 1;
          std::memcpy(at, fresh, sizeof fresh);
        }
      }
  }

  static void interleave(const std::array<const Byte*, 8>& from, int count, Byte* to) {
    for (int i = 0; i < count; i += kLightLanes) {
      Bytes rows[8];
      for (std::size_t r = 0; r < 8; ++r) std::memcpy(&rows[r], from[r] + i, sizeof(Bytes));
      for (int round = 0; round < 3; ++round) shuffle_all<4>(rows);
      std::uint64_t cells[kLightLanes];
      std::memcpy(cells, rows, sizeof cells);
      const int some = count - i < kLightLanes ? count - i : kLightLanes;
      for (int c = 0; c < some; ++c)
        std::memcpy(to + (i + c) * sizeof(LightBytes), &cells[c], sizeof cells[c]);
    }
  }
};

template <class Arch>
LightLoops light_loops_for() {
  using Of = LightSweeps<Arch>;
  return {Of::density, Of::emission, Of::side, Of::lamp, Of::transpose, Of::interleave};
}

}  // namespace voxmelt::render
