// The flow of the viscous law runs over all slices: settle, spread (exchange, carry), fall.
//
// A tile is awake for a phase if something that the phase reads has changed since it last ran there:
//   settle    it changed since the last settle (in it, or since); its whole column is settled
//   exchange  it, or a tile beside it, changed since the last exchange; or some pair there may exchange
//             something at another step's dither
//   fall      it, or a tile beside it, changed since the last fall
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/engine/parallel/chunks.h"
#include "kernel/engine/parallel/currents.h"
#include "kernel/engine/parallel/job.h"
#include "kernel/engine/parallel/layer_memory.h"

namespace voxmelt::parallel {

class ViscousFlow {
 public:
  ViscousFlow(const rule::ViscousLaw& law, state::Grid grid, const simd::View& view, int chunks);

  void note(const Tiles& changed);  // changes of phases that are not here
  void settle(const Job& job, simd::Books& books);
  void spread(const Job& job, simd::Books& books);
  void fall(const Job& job, simd::Books& books);  // the last phase of a step

  // Adds the tiles that are awake in the next step, and those whose neighbours are awake, too.
  void tell_awake(Tiles& own, Tiles& with_neighbours) const;

  // Returns the tiles that the three phases have changed in this step.
  const Tiles& take_changed();

 private:
  struct Worker {
    std::vector<SliceCurrents> ring;  // in a chunk: two; at a cut: one, for the slice before it
    state::Pages scratch;
    LayerMemory layer;  // in which it relaxes layers
    std::vector<TileRow> work, changed;
    simd::Books books;
  };

  void find_work(const Job& job, const Tiles* noted, int z, bool beside, Worker& worker);
  void relax(const Job& job);
  void exchange(const Job& job, int z, Worker& worker, SliceCurrents& to);
  void spread_chunk(const Job& job, int chunk);
  void note(int z, const TileRow* changed);
  void close(simd::Books& books);

  Chunks chunks_;
  cpu::Turns settle_turns_, relax_turns_, cut_turns_, chunk_turns_, fall_turns_;
  RunMemory memory_;
  Tiles for_settle_, for_exchange_, for_fall_, taken_, restless_, changed_, changed_before_;
  std::vector<Worker> chunk_, cut_;
  SliceCurrents none_;                      // currents of the slice before the first: empty
  std::uint32_t substeps_ = 0;              // number of sub-steps at the last settle
  int stages_ = 1;                          // number of stages then
  state::LimitCounts<std::int64_t> limit_;  // counts over all columns, at the last settle
};

}  // namespace voxmelt::parallel
