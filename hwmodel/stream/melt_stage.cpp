// Melting: hot solids become liquid; with the extra `reheat` hot liquid gains energy.
#include <cstdint>
#include <memory>

#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

class Melt final : public Stage {
 public:
  explicit Melt(const Design& design)
      : Stage("melt", "melt", design, 0),
        melts_at_(design.parameters.material.melting_point + design.parameters.material.latent_heat),
        paper_(design.paper()),
        reheat_(design.paper() ? design.parameters.flow.paper.reheat : 0) {}

  int output_bits() const override { return design().cell_bits() + (design().walls_in_conduction() ? 1 : 0); }
  Units units() const override { return {.multipliers = reheat_ > 0 ? 1 : 0}; }

 private:
  void advance(const Cell* in, Cell* out) override {
    for (int lane = 0; lane < lanes(); ++lane) {
      Cell& cell = out[lane];
      cell = in[lane];
      if (!cell.matter() || cell.heat < melts_at_) continue;
      if (cell.state == State::solid)
        melt(cell, lane);
      else if (reheat_ > 0)
        cell.energy = cell.energy + scale(cell.amount - cell.energy, reheat_);
    }
  }

  void melt(Cell& cell, int lane) {
    if (armed(Fault::melt_stuck)) [[unlikely]]
      return strike(came().x + lane, came().y, came().z);
    cell.state = State::liquid;
    if (!paper_) return;
    cell.energy = cell.amount;
    if (!armed(Fault::melt_energy)) [[likely]]
      return;
    cell.energy = cell.amount - 1;
    strike(came().x + lane, came().y, came().z);
  }

  const UInt<16> melts_at_;
  const bool paper_;
  const std::int64_t reheat_;
};

}  // namespace

std::unique_ptr<Stage> make_melt(const Design& design) { return std::make_unique<Melt>(design); }

}  // namespace voxmelt::hwmodel
