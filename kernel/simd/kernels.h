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

// What the cells of some rows of one slice give in the paper law's spread: written by `pattern`, read by
// `apply`. Arrays begin with row `first_row`, the first of a tile.
struct Gifts {
  int first_row = 0, rows = 0;
  std::uint64_t* planes = nullptr;  // [row][1 + words + 1][8]: directions given to, one plane per direction
  TileRow* giving = nullptr;        // [row]: words with a plane that is not empty; the planes of others are 0
  TileRow *giving_left = nullptr,
          *giving_right = nullptr;  // [row]: those that give into the word beside them
  TileRow* giving_tiles = nullptr;  // [tile row]: of all its rows
  std::uint16_t* flow[8] = {};      // [row][x]: amount given to a direction of the pattern
  std::uint16_t* energy[8] = {};    // [row][x]
  std::uint16_t* heat = nullptr;    // [row][x]: heat of the giver, xor 0x8000

  [[gnu::always_inline]] std::size_t row(int y) const { return static_cast<std::size_t>(y - first_row); }
  [[gnu::always_inline]] TileRow& tiles(const View& view, int r) const {
    return giving_tiles[r - (first_row >> view.tile_shift)];
  }
};

// Phases work on one tile row r of one slice z; `work` and what they return are sets of its tiles.
struct Kernels {
  // Paper law: gravity and excess through the upper faces of the cells of r, which must follow those of r
  // - 1. `follow`: the tiles in which those moved something into r; then, the same for r + 1. Adds to
  // changed[r] and changed[r + 1].
  void (*gravity)(const View&, const Step&, int z, int r, TileRow work, TileRow& follow, TileRow* changed,
                  Books&) = nullptr;
  // Paper law: what the cells give; returns the tiles where some cell may give, whatever the dice say.
  // `below`: liquid of the row below r before spread changed it; null where the mask still has it.
  TileRow (*pattern)(const View&, const Step&, int z, int r, TileRow work, const std::uint64_t* below,
                     Gifts&) = nullptr;
  // Paper law: every cell gives and takes; gifts of slices z - 1, z, z + 1. Returns the tiles that changed.
  TileRow (*apply)(const View&, const Step&, int z, int r, const Gifts& below, const Gifts& own,
                   const Gifts& above, Books&) = nullptr;
};

// The kernels that a scene needs; `set` must be supported.
Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters);

}  // namespace voxmelt::simd
