// The flow of the paper's law runs over all slices: gravity, then spread. The two halves of spread (pattern,
// apply) are one pass over memory. A chunk of slices is worked on band by band, upwards. A band is a tile
// row, or several if most tiles are awake. It carries three slices of gifts along z, which fit into the first
// cache levels.
//
// In a chunk that is mostly awake, gravity joins that pass if nobody looks at the state in between. It then
// runs a slice ahead of the patterns that read it, as these run ahead of apply. Slices at a cut fall before.
//
// A tile is awake for a phase if something that the phase reads has changed since it last ran there:
//   gravity  it, or a tile beside it, changed since the last gravity (in it, or since), or melted before it:
//            only now does the melted cell no longer count as a side
//   pattern  the same, this step's gravity included; or some cell may give and only the dice said no
//   apply    it or a neighbour gives
// All three read no further than the next tile (gravity's kernel itself follows a chain up a column). So a
// tile that sleeps would compute what it already holds.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/engine/parallel/bands.h"
#include "kernel/engine/parallel/chunks.h"
#include "kernel/engine/parallel/gifts.h"
#include "kernel/engine/parallel/job.h"

namespace voxmelt::parallel {

class PaperFlow {
 public:
  PaperFlow(const rule::Parameters& parameters, const simd::View& view, int chunks);

  // `dirty` holds the tiles that changed since the last step. Spread leaves in `dirty_next` the tiles that
  // this step's gravity and spread changed.
  void gravity(const Job& job, const Tiles& dirty, simd::Books& books);
  void spread(const Job& job, const Tiles& dirty, Tiles& dirty_next, simd::Books& books);

  // Returns the tiles that are awake in the next step, even if nothing changes beside them.
  const Tiles& restless() const { return restless_; }

 private:
  struct Worker {
    // Is a ring of three in a chunk. At a cut it has the gifts of the slices before and after it.
    std::vector<SliceGifts> gifts;
    std::vector<SliceGifts> tall_gifts;  // in a chunk: the same for tall bands
    std::vector<std::uint8_t> awake;     // slices in which patterns must be looked for
    // Holds for each slice the liquid in the last row of the tile row below, before spread.
    std::vector<std::uint64_t> ceiling;
    bool ahead = false;           // gravity of this step has been put off, except for slices at cuts
    std::vector<TileRow> follow;  // if ahead, for each slice: tiles that moved the first row of the next band
    std::vector<TileRow> moved;   // working memory of fall_band
    simd::Books books;
  };
  struct Sweep {
    const Job& job;
    const simd::View& tall;  // its tile rows are tall bands
    const Tiles& dirty;
    Tiles& dirty_next;
  };
  struct Slices {
    int begin, end;
  };

  void fall(const Job& job, const Tiles& dirty, int z, Worker& worker);
  void fall_band(const Job& job, const Band& band, int z, Worker& worker);
  Slices put_off(int chunk) const;  // slices of which gravity may be put off
  bool awake(const Sweep& sweep, int z) const;
  TileRow awake(const Sweep& sweep, const Band& band, int z) const;
  void find_patterns(const Sweep& sweep, const Band& band, int z, TileRow given, const std::uint64_t* below,
                     SliceGifts& gifts);
  void run_cut(const Sweep& sweep, int cut);
  void run_chunk(const Sweep& sweep, int chunk);
  void run_band(const Sweep& sweep, int chunk, const Band& band, std::vector<SliceGifts>& ring);
  void close(simd::Books& books);

  Chunks chunks_;
  Bands bands_;
  cpu::Turns gravity_turns_, cut_turns_, chunk_turns_;
  Tiles fallen_, restless_;
  std::vector<Worker> chunk_, cut_;
  SliceGifts none_;  // gifts of slices beyond the grid: empty
};

}  // namespace voxmelt::parallel
