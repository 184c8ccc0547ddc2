// Every instruction set offers the phases as kernels, one slice (all cells of one z) at a time, on raw
// memory.
//
// Work is chosen by tiles. A tile is 64 cells along x (one mask word), 2^tile_shift rows along y, one slice.
// A TileRow has one bit per word of x (grids are at most 4096 wide), [tile row]. A kernel may do more than it
// is asked, never less. It reports what it changes.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/ledger_terms.h"
#include "kernel/engine/cpu/instruction_set.h"

namespace voxmelt::simd {

using TileRow = std::uint64_t;

// Points to the memory of a state::Volume. Rows begin at multiples of 64 cells.
struct View {
  std::uint16_t *amount = nullptr, *energy = nullptr, *heat = nullptr;
  std::uint8_t* material = nullptr;      // null unless the scene has several
  const std::uint64_t* walls = nullptr;  // at (0, 0, 0) of a plane one word and one row wider at every side
  const std::uint64_t* sides = nullptr;  // the same before this step's melt, for the paper law's gravity
  std::uint64_t *solid = nullptr, *liquid = nullptr, *inert = nullptr;
  std::uint64_t* set = nullptr;  // cells that are set, by the last melt; null in scenes that do not freeze
  int nx = 0, ny = 0, nz = 0;
  std::size_t row = 0, slice = 0;  // cells from y to y + 1, from z to z + 1
  int words = 0;                   // mask words in a row
  int tile_shift = 3;              // rows of a tile: 2^tile_shift
  std::uint64_t last_word = 0;     // bits of a row's last word that are cells

  [[gnu::always_inline]] std::size_t cell(int w, int y, int z) const {
    return z * slice + y * row + 64 * static_cast<std::size_t>(w);
  }
  [[gnu::always_inline]] int tile_rows() const { return ((ny - 1) >> tile_shift) + 1; }
  [[gnu::always_inline]] int tile_begin(int r) const { return r << tile_shift; }
  [[gnu::always_inline]] int tile_end(int r) const {
    const int end = (r + 1) << tile_shift;
    return end < ny ? end : ny;
  }
  [[gnu::always_inline]] std::size_t word(int w, int y, int z) const {
    return (static_cast<std::size_t>(z) * ny + y) * words + w;
  }
  // Returns the cells of a word that are set, w from 0 on.
  [[gnu::always_inline]] std::uint64_t set_cells(int w, int y, int z) const {
    return set == nullptr ? 0 : set[word(w, y, z)];
  }
  // Returns the cells that are solid, inert or beyond the grid: w from -1 to words, y from -1 to ny, z from
  // -1 to nz.
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

// Holds what a step needs besides the state.
struct Step {
  const rule::Parameters* parameters = nullptr;
  std::uint32_t number = 0;
  std::uint32_t dither = 0;                   // D(s); in sub-steps, the dither of mixtures
  const std::uint32_t* keys = nullptr;        // keys of the random function
  const std::uint16_t* irradiance = nullptr;  // null without radiation
  std::uint32_t pair_dither[4] = {};          // viscous law: D(s, axis, 4)
  std::uint32_t turn[4] = {};                 // turn of the axes in this sub-step, times 65536
  std::uint32_t substeps = 1;                 // number of sub-steps of the step
  int stages = 1;                             // in which heads relax in a sub-step
  // They do the work of `relaxed_reach` sub-steps, which is 2^relaxed_bits at most, and relaxed_scale / 32768
  // times as much at least.
  int relaxed_reach = 1, relaxed_bits = 0, relaxed_scale = 32768;
};

// Holds the terms of the ledgers, summed over what a kernel did. For conducted and convected, only the sum
// over a whole pass has a meaning (see PairBooks).
using Books = state::LedgerTerms<std::int64_t>;

// Holds what the cells of some rows of one slice give in the paper law's spread. `pattern` writes it, and
// `apply` reads it. Arrays begin with row `first_row`, the first of a tile.
struct Gifts {
  int first_row = 0, rows = 0;
  std::uint8_t* pattern = nullptr;  // [row][x]: directions given to, a bit each; 0 in words that give nothing
  std::uint64_t* givers = nullptr;  // [row][1 + words + 1]: cells whose pattern is not 0
  TileRow* giving = nullptr;        // [row]: words with givers
  TileRow* giving_tiles = nullptr;  // [tile row]: words with givers in any of its rows
  std::uint16_t* flow[8] = {};      // [row][x]: amount given to a direction of the pattern
  std::uint16_t* energy[8] = {};    // [row][x]
  std::uint16_t* heat = nullptr;    // [row][x]: heat of the giver, xor 0x8000

  [[gnu::always_inline]] std::size_t row(int y) const { return y - first_row; }
  [[gnu::always_inline]] std::size_t word(const View& view, int w, std::size_t row) const {
    return row * (view.words + 2) + 1 + w;
  }
  [[gnu::always_inline]] TileRow& tiles(const View& view, int r) const {
    return giving_tiles[r - (first_row >> view.tile_shift)];
  }
};

// Points to the heats of three slices before a pass of conduction, [y][row], null beyond the grid. Up to 64
// cells before and after a slice may be read.
struct OldHeat {
  const std::uint16_t *below = nullptr, *own = nullptr, *above = nullptr;  // z - 1, z, z + 1
};

// Collects what a pass of heat finds out about the tiles of a slice, [tile row]. The pass adds to the sets.
struct HeatTiles {
  TileRow* changed = nullptr;
  TileRow* restless = nullptr;  // tiles that may change in a later step though they did not in this call
  TileRow* hot = nullptr;       // changed tiles in which something may melt
};

// Holds the flux through faces to cells that a sweep has not reached yet, modulo 65536.
struct HeatFlux {
  std::uint16_t* up = nullptr;     // [row]: from the row below
  std::uint16_t* front = nullptr;  // [y][row]: from the slice below
};

// Holds what a cell shows to its neighbours, under the viscous law. `settle` writes it for all cells of the
// columns that it is given, and nobody else does. Fields and masks are laid out as in View. All zero is a
// grid of air.
struct Runs {
  std::uint16_t* head = nullptr;      // 1024 + head above the cell's own bottom, 1/512 cell, cut at 65535
  std::uint16_t* mobility = nullptr;  // 1/65536, not limited yet, but cut above every limit
  std::uint16_t* fine = nullptr;      // 256ths of the mobility, in the upper byte
  std::uint16_t* limit = nullptr;     // 1/65536, not 0 where mobility is shown
  std::uint16_t* dead = nullptr;      // cut at 65535; outside runs, on a bed or on a run, it is 65535
  std::uint16_t* bed = nullptr;       // 1 + the bed above the grid's bottom, 1/16 cell
  std::uint16_t *deep_low = nullptr, *deep_high = nullptr;  // all 32 bits of a head that is cut
  // These are null in scenes whose heads never relax: the cells of the run, and the relaxed head in 1/32768
  // cell, written by `relax` alone.
  std::uint16_t *filled = nullptr, *relaxed_low = nullptr, *relaxed_high = nullptr;
  std::uint64_t *in_run = nullptr, *shut = nullptr;    // shut: cells of full runs under a ceiling
  std::uint64_t* shown = nullptr;                      // cells that are not all zero
  TileRow* deep = nullptr;                             // [z][y]: words in which a head is cut
  state::LimitCounts<std::int64_t>* limits = nullptr;  // [z][word]: counts of its columns
};

// Holds what the pairs of one slice exchange in the viscous law's spread. Each pair is booked at its first
// cell (by x in the slice, by z out of it). `exchange_pairs` writes it, and `carry` reads it. Rows are as
// long as the fields', and 64 cells before and after must be readable. All is zero at first.
struct Currents {
  std::uint16_t* flow[4] = {};  // [y][row], signed: to (+x), (+z), (+x+z), (-x+z)
  std::uint16_t* heat[2] = {};  // [y][row], only with heat: heats of this slice and the next, xor 0x8000
  TileRow* giving = nullptr;    // [y]: words with a flow that is not 0
};

// Is the memory in which a layer relaxes. Layers lie as [1 + z][row], with a slice more before and after, and
// 64 cells more on both ends. Lists have a vector for each item. All is zero at first.
struct RelaxMemory {
  struct Item {
    std::ptrdiff_t place, cell;  // of the first of a vector of cells: in a layer, in the grid
  };
  std::uint16_t* leveling[4] = {};            // layers: what the pairs of a cell level; zero again at the end
  std::uint16_t *low[2] = {}, *high[2] = {};  // layers: heads after the last stage and the one before
  Item* items = nullptr;                      // list
  std::uint16_t *head = nullptr, *head_high = nullptr;  // lists
  std::int32_t *impetus = nullptr, *change = nullptr;   // lists
};

// `settle` needs one block of memory per thread, aligned to 64 bytes. Its contents do not matter between
// calls.
inline constexpr std::size_t kSettleGroup = 4, kSettleRecord = 1216;
[[gnu::always_inline]] inline constexpr std::size_t settle_scratch_bytes(int ny) {
  return kSettleGroup * ny * kSettleRecord + (kSettleGroup * ny * sizeof(std::uint64_t) + 63) / 64 * 64;
}

// Holds what cells take from isothermal walls in a pass of conduction. `find` writes it, and `add` reads it.
// It is laid out like heats and masks.
struct WallGains {
  std::uint16_t* gain = nullptr;
  std::uint64_t* cells = nullptr;  // cells that touch a wall
};

// Are null if a scene has no walls. `find` is for all slices before the pass, and `add` for all slices after
// it, with the same tiles.
struct WallKernels {
  void (*find)(const View&, const Step&, int z, const TileRow* tiles, const WallGains&,
               TileRow* restless) = nullptr;
  void (*add)(const View&, const Step&, int z, const TileRow* tiles, const WallGains&, const HeatTiles&,
              Books&) = nullptr;
};

// The paper law's kernels work on one tile row r of one slice z. Their `work` and their results are sets of
// its tiles. The others work on whole slices.
struct Kernels {
  // Runs gravity and excess through the upper faces of the cells of r, under the paper law. Call it for r
  // after r - 1. `follow` has the tiles in which row r - 1 moved something into r, and then the same for r +
  // 1. It adds to changed[r] and changed[r + 1].
  void (*gravity)(const View&, const Step&, int z, int r, TileRow work, TileRow& follow, TileRow* changed,
                  Books&) = nullptr;
  // Finds the gifts of the cells, under the paper law. It returns the tiles where some cell may give,
  // whatever the dice say. `below` is the liquid of the row below r before spread changed it, or null if the
  // mask still has it.
  TileRow (*pattern)(const View&, const Step&, int z, int r, TileRow work, const std::uint64_t* below,
                     Gifts&) = nullptr;
  // Lets every cell give and take, under the paper law, by the gifts of slices z - 1, z, z + 1. It returns
  // the tiles that changed.
  TileRow (*apply)(const View&, const Step&, int z, int r, const Gifts& below, const Gifts& own,
                   const Gifts& above, Books&) = nullptr;

  // The kernels of heat run in this order. One is null if a scene has no such rule. All work in place.

  // Conducts through faces, slices ascending. It needs old.below and old.above, and the slice itself holds
  // its old heats. `carried` has the tiles of the call for z - 1, which left its flux in HeatFlux. It is null
  // if there was no such call.
  void (*conduct_faces)(const View&, const Step&, int z, const OldHeat& old, const TileRow* carried,
                        const TileRow* tiles, HeatFlux&, const HeatTiles&, Books&) = nullptr;
  // Does this in place of conduct_faces if the scene has several materials. It takes heats as the next two
  // do. Then all three conduct from isothermal walls, too, and need no kernels for that.
  void (*conduct_faces_gathered)(const View&, const Step&, int z, const OldHeat& old, const TileRow* tiles,
                                 const HeatTiles&, Books&) = nullptr;
  // These conduct over edges, then over corners. They need the old heats of all three slices, their own as a
  // copy.
  void (*conduct_edges)(const View&, const Step&, int z, const OldHeat& old, const TileRow* tiles,
                        const HeatTiles&, Books&) = nullptr;
  void (*conduct_corners)(const View&, const Step&, int z, const OldHeat& old, const TileRow* tiles,
                          const HeatTiles&, Books&) = nullptr;
  // These run around each of the three kernels of conduction.
  WallKernels face_walls, edge_walls, corner_walls;
  // Convects in the columns of slice z. It uses HeatFlux::up.
  void (*convect)(const View&, const Step&, int z, const TileRow* tiles, HeatFlux&, const HeatTiles&,
                  Books&) = nullptr;
  // Applies radiation and air, cell by cell.
  void (*exchange)(const View&, const Step&, int z, const TileRow* tiles, const HeatTiles&, Books&) = nullptr;
  // Melts and reheats, freezes and sets. No tile is restless after it. With `freezes` it needs every tile
  // that has changed, and those beside it.
  void (*melt)(const View&, const Step&, int z, const TileRow* tiles, TileRow* changed, Books&) = nullptr;

  // Settles the columns of slice z that have a tile in `tiles` (viscous law, phase `excess`). `tiles` must
  // hold all that has changed since the last call. If the number of sub-steps has changed, that is
  // everything. `changed` gets the tiles in which the state, or what a cell shows, has changed.
  void (*settle)(const View&, const Step&, int z, const TileRow* tiles, Runs&, void* scratch,
                 TileRow* changed, Books&) = nullptr;
  // Computes the exchange of the pairs of the tiles of slice z, among themselves and with slice z + 1
  // (viscous law, phase `spread`, first half). `restless` gets the tiles in which some pair may exchange
  // something at some step if nothing changes.
  void (*exchange_pairs)(const View&, const Step&, int z, const TileRow* tiles, const Runs&,
                         TileRow* restless, Currents&) = nullptr;
  // Lets the heads of layer y relax, all slices (viscous law, before `exchange_relaxed`).
  void (*relax)(const View&, const Step&, int y, const Runs&, const RelaxMemory&) = nullptr;
  // Does what exchange_pairs does, in a step of several stages.
  void (*exchange_relaxed)(const View&, const Step&, int z, const TileRow* tiles, const Runs&,
                           TileRow* restless, Currents&) = nullptr;
  // Applies the exchange to slice z (viscous law, phase `spread`, second half). below and own are the
  // currents of slices z - 1 and z.
  void (*carry)(const View&, const Step&, int z, const Currents& below, const Currents& own, TileRow* changed,
                Books&) = nullptr;
  // Lets cells outside runs fall as under the paper law (viscous law, phase `gravity`).
  void (*fall)(const View&, const Step&, int z, const TileRow* tiles, const Runs&, TileRow* changed,
               Books&) = nullptr;

  bool freezes = false;
};

// Returns the kernels that a scene needs, compiled for an architecture of xsimd (choose_kernels.h).
template <class Arch>
Kernels kernels_for(const rule::Parameters& parameters);

// Returns the same by the instruction set, which must be supported.
Kernels kernels(cpu::InstructionSet set, const rule::Parameters& parameters);

}  // namespace voxmelt::simd
