// Phases heat and melt run over all slices here.
//
// A tile is awake for heat if it, or a tile beside it, has changed since its last heat (its heat, its
// amounts, its masks). It is also awake if another dither might move heat. Each pass wakes the neighbours of
// what it changes. New irradiance wakes a tile for radiation alone, in which each cell acts alone. A tile is
// awake for melt if it has changed since its last melt, and in scenes that freeze, also beside such a tile.
// Bodies of one temperature sleep.
#pragma once

#include <cstdint>
#include <vector>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/field.h"
#include "kernel/engine/parallel/chunks.h"
#include "kernel/engine/parallel/job.h"

namespace voxmelt::parallel {

class HeatFlow {
 public:
  HeatFlow(state::Grid grid, const simd::View& view, int chunks);

  void note(const Tiles& changed);                     // changes of other phases
  void note_light(const state::ChangedRows& changed);  // new irradiance
  void note_light();                                   // new irradiance, anywhere

  // Adds the tiles that are awake in the next step, and those whose neighbours are awake, too.
  void tell_awake(Tiles& own, Tiles& with_neighbours) const;

  // Both functions add to `changed` the tiles that they change.
  void heat(const Job& job, Tiles& changed, simd::Books& books);
  void melt(const Job& job, Tiles& changed, simd::Books& books);

 private:
  using Slice = state::Field<std::uint16_t>;
  struct Worker {
    std::vector<Slice> old;  // in a chunk: a ring of two; at a cut: the slices before and after it
    Slice up, front;
    simd::HeatFlux flux;
    std::vector<TileRow> moved, hot;  // found by a call of a kernel
    simd::Books books;
  };
  struct Neighbours {
    const std::uint16_t *below, *above;  // old heats; null beyond the grid
    bool first;                          // the slice is the first of its chunk
  };

  void wake(const Job& job);
  void save_cuts(const Job& job);
  void end_pass(const Job& job, bool wake_neighbours);
  void close(simd::Books& books);
  template <class Visit>
  void sweep(const Job& job, const Visit& visit);
  template <class Call>
  void call(int z, Worker& worker, const Call& kernel);
  template <class Pass>
  void with_walls(const Job& job, const simd::WallKernels& walls, const Pass& pass);
  void conduct_faces(const Job& job);
  using Gather = decltype(simd::Kernels::conduct_edges);
  void conduct_distant(const Job& job, Gather kernel);
  void convect(const Job& job);
  void exchange(const Job& job, int z, Worker& worker);
  void wake_for_melt(const Job& job);

  Chunks chunks_;
  cpu::Turns sweep_turns_, melt_turns_;
  Tiles stale_, taken_, awake_, restless_, moved_, for_melt_;
  Tiles changed_before_melt_;  // in scenes that freeze
  bool freezes_ = false;
  Tiles light_;  // with new irradiance
  int tile_shift_;
  TileRow all_;  // all tiles of a row
  std::vector<Worker> chunk_, cut_;
  Slice wall_gains_;            // for the whole grid; empty if a scene has no isothermal walls
  state::BitPlane wall_cells_;  // cells that touch a wall
};

}  // namespace voxmelt::parallel
