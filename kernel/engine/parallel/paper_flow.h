// The flow of the paper's law over all slices: gravity, then spread. The two halves of spread (pattern,
// apply) are one pass over memory. A chunk of slices is worked on tile row by tile row, upwards. It carries
// three slices of gifts along z, which fit into the first cache level.
//
// A tile is awake for a phase where something that the phase reads has changed since it last ran there:
//   gravity  it, or a tile beside it, changed since the last gravity (in it, or since), or melted before it:
//            only now that counts at the sides of cells
//   pattern  the same, this step's gravity included; or some cell may give and only the dice said no
//   apply    it or a neighbour gives
// All three read no further than the next tile (gravity's kernel itself follows a chain up a column). So a
// tile that sleeps would compute what it already holds.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/engine/parallel/chunks.h"
#include "kernel/engine/parallel/gifts.h"
#include "kernel/engine/parallel/job.h"

namespace voxmelt::parallel {

class PaperFlow {
 public:
  PaperFlow(const rule::Parameters& parameters, const simd::View& view, int chunks);

  // `dirty` holds the tiles that changed since the last step. Spread leaves in `dirty_next` what this step's
  // gravity and spread changed.
  void gravity(const Job& job, const Tiles& dirty, simd::Books& books);
  void spread(const Job& job, const Tiles& dirty, Tiles& dirty_next, simd::Books& books);

 private:
  struct Worker {
    std::vector<SliceGifts>
        gifts;  // of a chunk: a ring of three; at a cut: of the slices before and after it
    std::vector<std::uint8_t> awake;  // slices in which patterns must be looked for
    // For each slice: the liquid in the last row of the tile row below, before spread.
    std::vector<std::uint64_t> ceiling;
    simd::Books books;
  };
  struct Sweep {
    const Job& job;
    const Tiles& dirty;
    Tiles& dirty_next;
  };

  void fall(const Job& job, const Tiles& dirty, int z, Worker& worker);
  bool awake(const Sweep& sweep, int z) const;
  void find_patterns(const Sweep& sweep, int z, int r, const std::uint64_t* below, SliceGifts& gifts);
  void run_cut(const Sweep& sweep, int cut);
  void run_chunk(const Sweep& sweep, int chunk);
  void run_rows(const Sweep& sweep, int chunk, int r);
  void close(simd::Books& books);

  Chunks chunks_;
  cpu::Turns gravity_turns_, cut_turns_, chunk_turns_;
  Tiles fallen_, restless_;
  std::vector<Worker> chunk_, cut_;
  SliceGifts none_;  // of slices beyond the grid
};

}  // namespace voxmelt::parallel
