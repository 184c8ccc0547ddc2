// A cell gives under the paper's law by its own facts alone (docs/automaton.md, section 9): shares, caps and
// bounds. The pattern stage uses this to find the cells that may get something, and the apply stage to find
// those that do.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "hwmodel/pipeline/model/arithmetic.h"
#include "hwmodel/pipeline/model/cell.h"

namespace voxmelt::hwmodel {

// Names the bits of a pattern, in the order of kStepX and kStepZ.
enum Way : int { east, west, north, south, north_east, south_east, north_west, south_west };
inline constexpr int kFirstDiagonal = north_east;

class PaperFlow {
 public:
  explicit PaperFlow(const rule::Flow& flow)
      : law_(flow.paper),
        table_(flow.mobility_table),
        thermal_(flow.thermal_viscosity),
        eight_(law_.neighbours == 8),
        cap_(eight_ ? kOne : 2 * kOne),
        limit_((eight_ ? 11 : 8) * kOne) {}

  bool eight() const { return eight_; }
  std::int64_t limit() const { return limit_; }  // only a cell that holds less receives
  int flow_bits() const { return bits_for(cap_); }
  int arrival_bits() const { return bits_for(eight_ ? 5 * cap_ : 4 * cap_); }  // a sum of all that may come

  // `share` returns the share of a content for each axis direction, without a table. `part` returns what a
  // content of `whole` gives then, by one multiplier.
  std::int64_t share(std::int64_t heat) const {
    if (!thermal_) return law_.share;
    const std::int64_t most = eight_ ? 13107 : 16384;
    return std::min(law_.share * std::int64_t{looked_up(table_, heat >> 11)} >> 15, most);
  }
  std::int64_t part(std::int64_t whole, std::int64_t share) const {
    return std::min(scale(whole, share), cap_);
  }
  std::int64_t axis_flow(std::int64_t amount, std::int64_t heat) const { return part(amount, share(heat)); }

  // Holds the amount and energy given to one direction, before any friction.
  struct Gift {
    UInt<14> amount, energy;
    Gift quartered() const { return {amount >> 2, energy >> 2}; }
    friend bool operator==(const Gift&, const Gift&) = default;
  };
  Gift gift(std::int64_t amount, std::int64_t energy, std::int64_t share) const {
    const std::int64_t flow = part(amount, share);
    return {flow, std::min(flow, part(energy, share))};
  }
  std::int64_t table_share(std::int64_t pattern, int way) const {
    return looked_up(looked_up(law_.table, pattern), way);
  }

  // Returns the gift to every direction of a pattern. Nothing goes to the others.
  std::array<Gift, 8> gifts(std::int64_t amount, std::int64_t energy, std::int64_t heat,
                            std::int64_t pattern) const {
    std::array<Gift, 8> gifts{};
    const Gift plain = law_.use_table ? Gift{} : gift(amount, energy, share(heat));
    for (int way = 0; way < law_.neighbours; ++way) {
      if ((pattern >> way & 1) == 0) continue;
      gifts[way] = law_.use_table ? gift(amount, energy, table_share(pattern, way))
                                  : (way < kFirstDiagonal ? plain : plain.quartered());
    }
    return gifts;
  }

 private:
  const rule::PaperLaw& law_;
  const std::array<std::uint16_t, 32>& table_;
  bool thermal_, eight_;
  std::int64_t cap_, limit_;
};

}  // namespace voxmelt::hwmodel
