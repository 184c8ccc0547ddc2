// Loose pieces of solid fall (docs/automaton.md, section 15). All solids are searched for them only after a
// cell has gone that may have parted a piece. While pieces fall, only they and what is new are looked at. The
// code is free of kernel/automaton/rule on purpose.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/changed_rows.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::parallel {

// Is what a scene says of pieces, as in rule::Pieces.
struct FallOfPieces {
  std::uint32_t in_liquid = 1;
  std::int64_t density = 65536;
};

class LoosePieces {
 public:
  // Lets them fall by a cell. It returns the rows that have changed, until the next call.
  const state::ChangedRows& fall(const FallOfPieces& how, std::uint32_t step, state::Volume& volume);

  std::int64_t searches() const { return searches_; }  // calls that looked at all solids

 private:
  // Is a set of cells of a row, x0 <= x < x1.
  struct Run {
    int x0, x1, y, z;
    std::size_t piece;  // index of the first run of the same piece
  };
  static std::size_t root_of(std::vector<Run>& runs, std::size_t i);
  static void join(std::vector<Run>& runs, std::size_t a, std::size_t a_end, std::size_t b,
                   std::size_t b_end);
  static std::vector<Run> runs_of(const state::BitPlane& solids, state::Grid grid);

  bool still_hold(const state::Volume& volume);
  void search(const state::Volume& volume);
  void look_at_the_rest(const state::Volume& volume);
  bool touches_held(const state::Volume& volume, const Run& run) const;
  void mark_moving(const FallOfPieces& how, std::uint32_t step, const state::Volume& volume);
  void turn_columns(state::Volume& volume);

  state::BitPlane held_;    // solids that are held, by the last call; all others are looked at in each call
  state::BitPlane inert_;   // what holds them
  bool rest_ = false;       // there are others
  std::vector<Run> loose_;  // loose solids, by rows
  state::BitPlane moving_;  // those that move
  state::ChangedRows changed_;
  std::int64_t searches_ = 0;
};

}  // namespace voxmelt::parallel
