// Loose pieces of solid fall (docs/automaton.md, section 15). All solids are searched for them only after a
// cell has gone that may have parted a piece. The code is free of kernel/automaton/rule on purpose.
#pragma once

#include <cstdint>

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
  bool may_part(const state::Volume& volume);
  void mark_moving(const FallOfPieces& how, std::uint32_t step, const state::Volume& volume);
  void turn_columns(state::Volume& volume);

  state::BitPlane known_;   // solids that are all held; empty if some may be loose
  state::BitPlane inert_;   // what holds them
  state::BitPlane loose_;   // loose solids
  state::BitPlane moving_;  // those that move
  state::ChangedRows changed_;
  std::int64_t searches_ = 0;
};

}  // namespace voxmelt::parallel
