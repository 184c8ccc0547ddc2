// The state memory is the state as a train of passes sees it. A grid in one tile is replaced in place, behind
// the reader. Tiles overlap, so the neighbours of a tile still have to read the old state of what the tile
// writes. So there are two copies, and each pass reads one and writes the other.
//
// A step of several passes keeps which places are set, in the code of the state of what is not blocked.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <utility>

#include "hwmodel/pipeline/model/coded_state.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

class StateMemory {
 public:
  // `coded` tells how the state lies in memory. If it is null, there is no code. `set` is the grid if the
  // memory keeps which places are set.
  explicit StateMemory(bool tiled, const CodeLayout* coded = nullptr, std::optional<state::Grid> set = {})
      : tiled_(tiled) {
    if (set) set_.fill(state::BitPlane(*set));
    if (coded == nullptr) return;
    codes_[0].emplace(*coded);
    if (tiled) codes_[1].emplace(*coded);
  }

  // The state lies in `volume` before a train, and after it.
  void begin_train(state::Volume& volume) {
    if (tiled_ && !second_) second_ = volume;
    first_ = &volume;
    reads_first_ = true;
    writes_first_ = !tiled_;
    if (codes_[0]) codes_[0]->store(volume, read_set());
  }
  void end_train() {
    if (!tiled_ || !writes_first_) return;
    std::swap(*first_, *second_);
    std::swap(set_[0], set_[1]);
  }

  const state::Volume& read() const { return reads_first_ ? *first_ : *second_; }
  state::Volume& written() { return writes_first_ ? *first_ : *second_; }
  // Returns the copy that is not read. It holds the pass before as long as this one has not written it.
  const state::Volume& stale() const { return reads_first_ && tiled_ ? *second_ : *first_; }

  // Tell which places are set, of the same copies. Null: the memory keeps none.
  const state::BitPlane* read_set() const { return plane(reads_first_ ? 0 : 1); }
  state::BitPlane* written_set() { return set_[0].empty() ? nullptr : &set_[writes_first_ ? 0 : 1]; }
  const state::BitPlane* stale_set() const { return plane(reads_first_ && tiled_ ? 1 : 0); }

  // With hw.coded the machine reads and writes these. The volumes are what the host reads back of them.
  bool coded() const { return codes_[0].has_value(); }
  const CodedState& read_code() const { return *codes_[reads_first_ ? 0 : 1]; }
  // Returns the code of the copy that a train reads first (0), or of the other one (1). Null means that there
  // is none.
  const CodedState* code(int copy) const {
    const auto& code = codes_[copy];
    return code ? &*code : nullptr;
  }
  CodedState& written_code() { return *codes_[writes_first_ ? 0 : 1]; }

  // These are called when all tiles of a pass have been read, or written.
  void next_to_read() { reads_first_ = reads_first_ != tiled_; }
  void next_to_write() { writes_first_ = writes_first_ != tiled_; }

 private:
  const state::BitPlane* plane(std::size_t copy) const { return set_[0].empty() ? nullptr : &set_[copy]; }

  bool tiled_, reads_first_ = true, writes_first_ = true;
  state::Volume* first_ = nullptr;
  std::optional<state::Volume> second_;
  std::array<state::BitPlane, 2> set_;
  std::array<std::optional<CodedState>, 2> codes_;
};

}  // namespace voxmelt::hwmodel
