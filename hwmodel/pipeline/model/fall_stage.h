// Pieces fall (docs/automaton.md, section 15). The host has found the cells that fall, and a feed brings a
// bit for each. Each lane holds one cell. As long as the next cell up falls, it passes that one first and
// keeps the held one. So the cells of a piece in a column and the one cell below them turn round once. No
// cell at the bottom of a column falls, so columns need not be told apart.
#pragma once

#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class FallOfPieces final : public Stage {
 public:
  explicit FallOfPieces(const Design& design, Faults faults = {})
      : Stage(StageKind::fall, design, 1), faults_(faults), held_(design.shape.lanes) {}

  // Only the first time step of a cascade has a feed.
  void feed_falls(FallFifo& feed) override { feed_ = &feed; }

  std::vector<BufferCost> buffers() const override {
    return {{"cell register", 1, lanes(), design().cell_bits()}};
  }

 private:
  friend Faults;

  bool side_input_ready() override {
    if (feed_ == nullptr) throw ModelError("pieces fall in a time step that has no feed of them");
    return feed_->valid();
  }

  void advance(const Cell* in, Cell* out) override {
    compute_at(lag(), 0);
    if (in != nullptr && feed_->count() == 0)
      throw ModelError("the channel \"" + feed_->name() + "\" holds no token to take");
    const UInt<1>* falls = in != nullptr ? feed_->get() : nullptr;
    for (const int lane : each_lane(lag())) {
      bool passes = falls != nullptr && falls[lane] > 0;
      if (out != nullptr && in != nullptr) faults_.judged(*this, in[lane], falls, lane, passes);
      StoredCell leaves = held_[lane];
      if (passes)
        leaves = in[lane].stored();
      else if (in != nullptr)
        held_[lane] = in[lane].stored();
      if (out == nullptr) continue;
      faults_.turned_round(*this, lane, passes, leaves);
      out[lane] = {};
      out[lane].stored() = leaves;
    }
  }

  [[no_unique_address]] Faults faults_;
  FallFifo* feed_ = nullptr;
  std::vector<StoredCell> held_;
};

}  // namespace voxmelt::hwmodel
