// Hot solids melt to liquid, which is of the first material. With the extra `reheat`, hot liquid gains
// energy. In scenes that freeze, cold liquid freezes where it is full and touches something, and is set
// elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/materials.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class Melt final : public Stage {
 public:
  explicit Melt(const Design& design, Faults faults = {})
      : Stage(StageKind::melt, design, 0),
        faults_(faults),
        curves_(design.parameters),
        freezes_below_(design.freezes() ? design.parameters.material.freezing_point : 0),
        paper_(design.paper()),
        reheat_(design.paper() ? design.parameters.flow.paper.reheat : 0) {}

  Wires side_bands() const override {
    return Wires().add(Wire::beside_wall, design().walls_in_conduction()).add(Wire::set, design().freezes());
  }
  // A material is known by the heat that melts it, and by what is added to the heat of what melts.
  std::vector<BufferCost> buffers() const override {
    std::vector<BufferCost> buffers;
    add_table(buffers, "melting heats", design(), 16 + 17);
    return buffers;
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
      if (!cell.matter() || cell.heat < curves_.liquid_from(cell.material)) continue;
      if (cell.state == State::solid) {
        cell.state = State::liquid;
        cell.heat = curves_.melted(cell.heat, cell.material);
        cell.material = 0;
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
  const Curves curves_;
  const UInt<16> freezes_below_;  // 0 where nothing freezes
  const bool paper_;
  const std::int64_t reheat_;
};

}  // namespace voxmelt::hwmodel
