// What every instruction set offers: the phases, one slice (all cells of one z) at a time, on raw memory.
//
// Work is chosen by tiles: a tile is 64 cells along x (one mask word), 2^kTileShift rows along y, one slice.
// A TileRow is one bit per word of x (grids are at most 4096 wide), [tile row]. A kernel may do more than it
// is asked, never less. It reports what it changes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/ledger_terms.h"
#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::simd {

using TileRow = std::uint64_t;

// The memory of a state::Volume. Rows begin at multiples of 64 cells.
struct View {
  std::uint16_t *amount = nullptr, *energy = nullptr, *heat = nullptr;
  const std::uint64_t* walls = nullptr;  // at (0, 0, 0) of a plane one word and one row wider at every side
  const std::uint64_t* sides = nullptr;  // the same before this step's melt, for the paper law's gravity
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
  [[gnu::always_inline]] const std::uint64_t* sides_at(int y, int z) const {
    return sides + (static_cast<std::ptrdiff_t>(z) * (ny + 2) + y) * (words + 2);
  }
};

// Prefetches the 64 cells of a word, for processors whose hardware prefetcher stops at a page.
[[gnu::always_inline]] inline void prefetch_word(const std::uint16_t* cells) {
  __builtin_prefetch(cells);
  __builtin_prefetch(cells + 32);
}

// What a step needs besides the state.
struct Step {
  const rule::Parameters* parameters = nullptr;
  std::uint32_t number = 0;
  std::uint32_t dither = 0;                   // D(s); in sub-steps, of mixtures
  const std::uint32_t* keys = nullptr;        // of the random function
  const std::uint16_t* irradiance = nullptr;  // null without radiation
  std::uint32_t pair_dither[4] = {};          // viscous law: D(s, axis, 4)
  std::uint32_t turn[4] = {};                 // of the axes in this sub-step, times 65536
  std::uint32_t substeps = 1;                 // of the step
};

// Terms of the ledgers, summed over what a kernel did. For conducted and convected, only the sum over a whole
// pass has a meaning: see PairBooks.
using Books = state::LedgerTerms<std::int64_t>;

// What the cells of some rows of one slice give in the paper law's spread: written by `pattern`, read by
// `apply`. Arrays begin with row `first_row`, the first of a tile.
struct Gifts {
  int first_row = 0, rows = 0;
  std::uint8_t* pattern = nullptr;  // [row][x]: directions given to, a bit each; 0 in words that give nothing
  std::uint64_t* givers = nullptr;  // [row][1 + words + 1]: cells whose pattern is not 0
  TileRow* giving = nullptr;        // [row]: words with givers
  TileRow* giving_tiles = nullptr;  // [tile row]: of all its rows
  std::uint16_t* flow[8] = {};      // [row][x]: amount given to a direction of the pattern
  std::uint16_t* energy[8] = {};    // [row][x]
  std::uint16_t* heat = nullptr;    // [row][x]: heat of the giver, xor 0x8000

  [[gnu::always_inline]] std::size_t row(int y) const { return static_cast<std::size_t>(y - first_row); }
  [[gnu::always_inline]] std::size_t word(const View& view, int w, std::size_t row) const {
    return row * static_cast<std::size_t>(view.words + 2) + 1 + static_cast<std::size_t>(w);
  }
  [[gnu::always_inline]] TileRow& tiles(const View& view, int r) const {
    return giving_tiles[r - (first_row >> view.tile_shift)];
  }
};

// Heats of three slices before a pass of conduction, [y][row]; null beyond the grid. Up to 64 cells before
// and after a slice may be read.
struct OldHeat {
  const std::uint16_t *below = nullptr, *own = nullptr, *above = nullptr;  // z - 1, z, z + 1
};

// What a pass of heat finds out about the tiles of a slice, [tile row]; it adds to the sets.
struct HeatTiles {
  TileRow* changed = nullptr;
  TileRow* restless = nullptr;  // may change in a later step though they did not in this call
  TileRow* hot = nullptr;       // of those that changed, all in which something may melt
};

// What flows through faces to cells that a sweep has not reached yet, modulo 65536.
struct HeatFlux {
  std::uint16_t* up = nullptr;     // [row]: from the row below
  std::uint16_t* front = nullptr;  // [y][row]: from the slice below
};

// Viscous law: what a cell shows to its neighbours, written by `settle` for all cells of the columns that it
// is given, not changed by others. Fields and masks are laid out as in View; all zero is a grid of air.
struct Runs {
  std::uint16_t* head = nullptr;      // 1024 + head above the cell's own bottom, 1/512 cell, cut at 65535
  std::uint16_t* mobility = nullptr;  // 1/65536, not limited yet, but cut above every limit
  std::uint16_t* fine = nullptr;      // its 256ths, in the upper byte
  std::uint16_t* limit = nullptr;     // 1/65536, not 0 where mobility is shown
  std::uint16_t* dead = nullptr;      // cut at 65535, which a cell outside a run on a bed or a run has
  std::uint16_t* bed = nullptr;       // 1 + the bed above the grid's bottom, 1/16 cell
  std::uint16_t *deep_low = nullptr, *deep_high = nullptr;  // where head is cut: all 32 bits of it
  std::uint64_t *in_run = nullptr, *shown = nullptr;        // shown: cells that are not all zero
  TileRow* deep = nullptr;                                  // [z][y]: words in which a head is cut
  state::LimitCounts<std::int64_t>* limits = nullptr;       // [z][word]: of its columns
};

// What the pairs of one slice exchange in the viscous law's spread, each pair booked at its first cell (by x
// in the slice, by z out of it): written by `exchange_pairs`, read by `carry`. Rows are as long as the
// fields'; 64 cells before and after must be readable. All zero at first.
struct Currents {
  std::uint16_t* flow[4] = {};  // [y][row], signed: to (+x), (+z), (+x+z), (-x+z)
  std::uint16_t* heat[2] = {};  // [y][row], with heat: of this slice and the next, xor 0x8000, where needed
  TileRow* giving = nullptr;    // [y]: words with a flow that is not 0
};

// Memory for `settle`: one block per thread, aligned to 64 bytes; what it holds between calls is nothing.
inline constexpr std::size_t kSettleGroup = 4, kSettleRecord = 1216;
[[gnu::always_inline]] inline constexpr std::size_t settle_scratch_bytes(int ny) {
  return kSettleGroup * static_cast<std::size_t>(ny) * kSettleRecord +
         (kSettleGroup * static_cast<std::size_t>(ny) * sizeof(std::uint64_t) + 63) / 64 * 64;
}

// What cells take from isothermal walls in a pass of conduction: written by `find`, read by `add`. Laid out
// like heats and masks.
struct WallGains {
  std::uint16_t* gain = nullptr;
  std::uint64_t* cells = nullptr;  // that touch a wall
};

// Null where a scene has no walls. `find` is for all slices before the pass, and `add` for all slices after
// it, with the same tiles.
struct WallKernels {
  void (*find)(const View&, const Step&, int z, const TileRow* tiles, const WallGains&,
               TileRow* restless) = nullptr;
  void (*add)(const View&, const Step&, int z, const TileRow* tiles, const WallGains&, const HeatTiles&,
              Books&) = nullptr;
};

// The paper law works on one tile row r of one slice z; `work` and what it returns are sets of its tiles. The
// others work on whole slices.
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

  // Heat, in this order; null where a scene has no such rule. All work in place.

  // Conduction through faces, slices ascending. Needs old.below and old.above; the slice itself holds its old
  // heats. `carried`: the tiles of the call for z - 1, which left its flux in HeatFlux; null: there was none.
  void (*conduct_faces)(const View&, const Step&, int z, const OldHeat& old, const TileRow* carried,
                        const TileRow* tiles, HeatFlux&, const HeatTiles&, Books&) = nullptr;
  // Conduction over edges, then over corners. Needs the old heats of all three slices, its own as a copy.
  void (*conduct_edges)(const View&, const Step&, int z, const OldHeat& old, const TileRow* tiles,
                        const HeatTiles&, Books&) = nullptr;
  void (*conduct_corners)(const View&, const Step&, int z, const OldHeat& old, const TileRow* tiles,
                          const HeatTiles&, Books&) = nullptr;
  // Around each of these three.
  WallKernels face_walls, edge_walls, corner_walls;
  // Convection in the columns of slice z; uses HeatFlux::up.
  void (*convect)(const View&, const Step&, int z, const TileRow* tiles, HeatFlux&, const HeatTiles&,
                  Books&) = nullptr;
  // Radiation and air, cell by cell.
  void (*exchange)(const View&, const Step&, int z, const TileRow* tiles, const HeatTiles&, Books&) = nullptr;
  // Melting and reheating; no tile is restless after it.
  void (*melt)(const View&, const Step&, int z, const TileRow* tiles, TileRow* changed, Books&) = nullptr;

  // Viscous law, phase `excess`: settles the columns of slice z that have a tile in `tiles`, which must hold
  // all that has changed since the last call: everything, if the number of sub-steps has. `changed`: where
  // the state, or what a cell shows, is not what it was.
  void (*settle)(const View&, const Step&, int z, const TileRow* tiles, Runs&, void* scratch,
                 TileRow* changed, Books&) = nullptr;
  // Viscous law, phase `spread`, first half: what the pairs of the tiles of slice z exchange, among
  // themselves and with slice z + 1. `restless`: where some pair may exchange something at some step if
  // nothing changes.
  void (*exchange_pairs)(const View&, const Step&, int z, const TileRow* tiles, const Runs&,
                         TileRow* restless, Currents&) = nullptr;
  // Viscous law, phase `spread`, second half: slice z. below, own: currents of slices z - 1 and z.
  void (*carry)(const View&, const Step&, int z, const Currents& below, const Currents& own, TileRow* changed,
                Books&) = nullptr;
  // Viscous law, phase `gravity`: like the paper law's, for cells outside runs.
  void (*fall)(const View&, const Step&, int z, const TileRow* tiles, const Runs&, TileRow* changed,
               Books&) = nullptr;
};

// The kernels that a scene needs, compiled for an architecture of xsimd (choose_kernels.h).
template <class Arch>
Kernels kernels_for(const rule::Parameters& parameters);

// The same by the instruction set, which must be supported.
Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters);

}  // namespace voxmelt::simd
