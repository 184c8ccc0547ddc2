// Hot solids melt to liquid. With the extra `reheat`, hot liquid gains energy. In scenes that freeze, cold
// liquid freezes where it is full and touches something, and is set elsewhere.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class Melt final : public Stage {
 public:
  explicit Melt(const Design& design, Faults faults = {})
      : Stage(StageKind::melt, design, 0),
        faults_(faults),
        melts_at_(design.parameters.material.melting_point + design.parameters.material.latent_heat),
        freezes_below_(design.freezes() ? design.parameters.material.freezing_point : 0),
        paper_(design.paper()),
        reheat_(design.paper() ? design.parameters.flow.paper.reheat : 0) {}

  Wires side_bands() const override {
    return Wires().add(Wire::beside_wall, design().walls_in_conduction()).add(Wire::set, design().freezes());
  }
  Units units() const override { return {.multipliers = reheat_ > 0 ? 1 : 0}; }

 private:
  friend Faults;

  void advance(const Cell* in, Cell* out) override {
    for (const int lane : each_lane()) {
      Cell& cell = out[lane];
      cell = in[lane];
      cell.touches = 0;
      if (cell.liquid() && cell.heat < freezes_below_) cool(in[lane], cell);
      faults_.cooled(*this, in[lane], lane, cell);
      if (!cell.matter() || cell.heat < melts_at_) continue;
      if (cell.state == State::solid) {
        cell.state = State::liquid;
        if (paper_) cell.energy = cell.amount;
        faults_.melted(*this, in[lane], lane, cell);
      } else if (reheat_ > 0) {
        cell.energy = cell.energy + scale(cell.amount - cell.energy, reheat_);
      }
    }
  }

  // Freezes or sets cold liquid.
  static void cool(const Cell& in, Cell& cell) {
    cell.set = in.touches == 0 || in.amount < kFull;
    if (cell.set > 0) return;
    cell.state = State::solid;
    cell.energy = 0;
  }

  static constexpr std::int64_t kFull = kOne - kOne / 64;  // the least amount that freezes

  [[no_unique_address]] Faults faults_;
  const UInt<16> melts_at_, freezes_below_;  // the latter is 0 where nothing freezes
  const bool paper_;
  const std::int64_t reheat_;
};

}  // namespace voxmelt::hwmodel
