// The state in memory, as a train of passes sees it. A grid in one tile is replaced in place, behind the
// reader. Tiles overlap: what one writes, its neighbours still have to read as it was. So there are two
// copies, and each pass reads one and writes the other.
#pragma once

#include <optional>
#include <utility>

#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

class StateMemory {
 public:
  explicit StateMemory(bool tiled) : tiled_(tiled) {}

  // The state lies in `volume` before a train, and after it.
  void begin_train(state::Volume& volume) {
    if (tiled_ && !second_) second_ = volume;
    first_ = &volume;
    reads_first_ = true, writes_first_ = !tiled_;
  }
  void end_train() {
    if (tiled_ && writes_first_) std::swap(*first_, *second_);
  }

  const state::Volume& read() const { return reads_first_ ? *first_ : *second_; }
  state::Volume& written() { return writes_first_ ? *first_ : *second_; }
  // What the copy that is not read holds: of the pass before, as long as this one has not written it.
  const state::Volume& stale() const { return reads_first_ && tiled_ ? *second_ : *first_; }

  // All tiles of a pass have been read, or written.
  void next_to_read() { reads_first_ = reads_first_ != tiled_; }
  void next_to_write() { writes_first_ = writes_first_ != tiled_; }

 private:
  bool tiled_, reads_first_ = true, writes_first_ = true;
  state::Volume* first_ = nullptr;
  std::optional<state::Volume> second_;
};

}  // namespace voxmelt::hwmodel
