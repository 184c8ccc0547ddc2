// Conduction through faces; and what else the six face neighbours tell: the exposed axes of each cell, for
// the exchange with air, and whether one of its four sides is blocked, for gravity.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hwmodel/stream/conduction_pass.h"
#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

class FaceConduction final : public ConductionPass<kFacePairs> {
 public:
  explicit FaceConduction(const Design& design)
      : ConductionPass("conduction", design, design.parameters.heat.weight_face,
                       design.parameters.heat.neighbours < 18),
        counts_axes_(design.parameters.heat.air),
        finds_walls_(design.walls_in_conduction()) {}

  std::vector<BufferCost> buffers() const override { return heat_buffers(design(), kFacePairs, 3); }

 private:
  void watch() override {
    if (counts_axes_) {
      expose<0>();
      expose<1>();
      expose<2>();
    }
    if (finds_walls_) find_walls();
    if (armed(Fault::buffer_bit)) [[unlikely]]
      flip_bit();
  }

  std::int64_t exposed_axes(const HeatWord& word) const override {
    return std::popcount(static_cast<unsigned>(std::int64_t{word.exposed}));
  }

  template <std::size_t kAxis>
  void expose() {
    each_pair<kAxis>([](HeatWord& p, HeatWord& q) {
      if (p.air() && q.matter()) q.exposed = q.exposed | (1 << kAxis);
      if (q.air() && p.matter()) p.exposed = p.exposed | (1 << kAxis);
    });
  }

  void find_walls() {
    const auto touch = [](HeatWord& p, HeatWord& q) {
      if (p.blocked()) q.beside_wall = 1;
      if (q.blocked()) p.beside_wall = 1;
    };
    each_pair<0>(touch);
    each_pair<2>(touch);
    const state::Grid& grid = shape().grid;
    const bool at_end = came().z == 0 || came().z == grid.z - 1;  // the border is blocked
    for (int lane = 0; lane < lanes(); ++lane)
      if (const int x = came().x + lane; at_end || x == 0 || x == grid.x - 1)
        word(kHere, lane).beside_wall = 1;
  }

  // In the word that leaves the plane memory: the lowest bit of the amount that is 0 (a cell's energy may not
  // exceed its amount, which therefore must not shrink).
  void flip_bit() {
    if (came().z == 0) return;
    for (int lane = 0; lane < lanes(); ++lane) {
      HeatWord& leaves = word(kSouth, lane);
      if (!leaves.matter() || leaves.amount == kAmountMax) continue;
      leaves.amount = leaves.amount | (leaves.amount + 1);
      return strike(came().x + lane, came().y, came().z - 1);
    }
  }

  const bool counts_axes_, finds_walls_;
};

}  // namespace

std::unique_ptr<Stage> make_conduction(const Design& design) {
  return std::make_unique<FaceConduction>(design);
}

}  // namespace voxmelt::hwmodel
