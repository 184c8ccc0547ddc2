// What every instruction set offers: the phases, one slice (all cells of one z) at a time, on raw memory.
//
// Work is chosen by tiles: a tile is 64 cells along x (one mask word), 2^kTileShift rows along y, one slice.
// A TileRow is one bit per word of x (grids are at most 4096 wide), [tile row]. A kernel may do more than it
// is asked, never less; what it changes it reports.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/cpu/instruction_set.h"
#include "kernel/rule/parameters.h"

namespace voxmelt::simd {

using TileRow = std::uint64_t;

// The memory of a state::Volume. Rows begin at multiples of 64 cells.
struct View {
  std::uint16_t *amount = nullptr, *energy = nullptr, *temperature = nullptr;
  const std::uint64_t* walls = nullptr;  // of (0, 0, 0), in a plane one word and one row wider at every side
  std::uint64_t *solid = nullptr, *liquid = nullptr, *inert = nullptr;
  int nx = 0, ny = 0, nz = 0;
  std::size_t row = 0, slice = 0;  // cells from y to y + 1, from z to z + 1
  int words = 0;                   // mask words in a row
  int tile_shift = 3;              // rows of a tile: 2^tile_shift
  std::uint64_t last_word = 0;     // bits of a row's last word that are cells

  [[gnu::always_inline]] std::size_t cell(int w, int y, int z) const {
    return static_cast<std::size_t>(z) * slice + static_cast<std::size_t>(y) * row +
           64 * static_cast<std::size_t>(w);
  }
  [[gnu::always_inline]] int tile_rows() const { return ((ny - 1) >> tile_shift) + 1; }
  [[gnu::always_inline]] int tile_begin(int r) const { return r << tile_shift; }
  [[gnu::always_inline]] int tile_end(int r) const {
    const int end = (r + 1) << tile_shift;
    return end < ny ? end : ny;
  }
  [[gnu::always_inline]] std::size_t word(int w, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(words) +
           static_cast<std::size_t>(w);
  }
  // Solid or inert, or beyond the grid: w from -1 to words, y from -1 to ny, z from -1 to nz.
  [[gnu::always_inline]] std::uint64_t blocked(int w, int y, int z) const { return walls_at(y, z)[w]; }
  [[gnu::always_inline]] const std::uint64_t* walls_at(int y, int z) const {
    return walls + (static_cast<std::ptrdiff_t>(z) * (ny + 2) + y) * (words + 2);
  }
};

// What a step needs besides the state.
struct Step {
  const rule::Parameters* parameters = nullptr;
  std::uint32_t number = 0;
  std::uint32_t dither = 0;                   // D(s)
  const std::uint32_t* keys = nullptr;        // of the random function
  const std::uint16_t* irradiance = nullptr;  // null without radiation
};

// Terms of the ledgers, summed over what a kernel did.
struct Books {
  std::int64_t accelerated = 0, dissipated = 0, capped = 0, rounded = 0;

  Books& operator+=(const Books& other) {
    accelerated += other.accelerated;
    dissipated += other.dissipated;
    capped += other.capped;
    rounded += other.rounded;
    return *this;
  }
};

// What the cells of one slice give in the paper law's spread: written by `pattern`, read by `apply`.
struct Gifts {
  std::uint64_t* planes = nullptr;  // [y][1 + words + 1][8]: directions given to, one plane per direction
  TileRow* giving = nullptr;        // [y]: words with a plane that is not empty; the planes of others are 0
  TileRow* giving_tiles = nullptr;  // [tile row]: of all its rows
  TileRow *giving_left = nullptr, *giving_right = nullptr;  // [y]: those that give into the word beside them
  std::uint16_t* flow[8] = {};    // [y][row]: amount given to a direction of the pattern
  std::uint16_t* energy[8] = {};  // [y][row]
  std::uint16_t* heat = nullptr;  // [y][row]: heat of the giver, xor 0x8000
};

struct Kernels {
  // Paper law: gravity and excess of the columns of slice z. `tiles`: where anything may move; what moves is
  // followed upwards beyond them.
  void (*gravity)(const View&, const Step&, int z, const TileRow* tiles, TileRow* changed, Books&) = nullptr;
  // Paper law: patterns of tiles in slice z; `restless`: tiles where some cell may give, whatever the dice
  // say.
  void (*pattern)(const View&, const Step&, int z, const TileRow* tiles, TileRow* restless, Gifts&) = nullptr;
  // Paper law: every cell of slice z gives and takes. below, own, above: gifts of slices z - 1, z, z + 1.
  void (*apply)(const View&, const Step&, int z, const Gifts& below, const Gifts& own, const Gifts& above,
                TileRow* changed, Books&) = nullptr;
};

// The kernels that a scene needs; `set` must be supported.
Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters);

}  // namespace voxmelt::simd
