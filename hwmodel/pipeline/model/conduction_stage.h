// Heat is conducted through faces. The six face neighbours also tell the exposed axes of each cell, for the
// exchange with air. They tell, too, if one of its four sides is blocked, for gravity.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/conduction_pass.h"

namespace voxmelt::hwmodel {

template <class Faults>
class FaceConduction final : public ConductionPass<kFacePairs, Faults> {
  using Pass = ConductionPass<kFacePairs, Faults>;
  using Pass::came, Pass::each_pair, Pass::lanes, Pass::shape, Pass::word;

 public:
  explicit FaceConduction(const Design& design, Faults faults = {})
      : Pass(StageKind::conduction, design, design.parameters.heat.weight_face, faults),
        counts_axes_(design.parameters.heat.air),
        finds_walls_(design.walls_in_conduction()) {}

  std::vector<BufferCost> buffers() const override { return heat_buffers(this->design(), kFacePairs, 3); }

 private:
  void watch() override {
    if (counts_axes_) {
      expose<0>();
      expose<1>();
      expose<2>();
    }
    if (finds_walls_) find_walls();
  }

  std::int64_t exposed_axes(const HeatWord& heat) const override {
    return std::popcount<std::uint64_t>(heat.exposed);
  }

  template <std::size_t kAxis>
  void expose() {
    each_pair(part<kAxis>, [](HeatWord& p, HeatWord& q) {
      if (p.air() && q.matter()) q.exposed = q.exposed | (1 << kAxis);
      if (q.air() && p.matter()) p.exposed = p.exposed | (1 << kAxis);
    });
  }

  void find_walls() {
    const auto touch = [](HeatWord& p, HeatWord& q) {
      if (p.blocked()) q.beside_wall = 1;
      if (q.blocked()) p.beside_wall = 1;
    };
    each_pair(part<0>, touch);
    each_pair(part<2>, touch);
    const state::Grid& grid = shape().grid;
    const bool at_end = came().z == 0 || came().z == grid.z - 1;  // the border is blocked
    for (int lane = 0; lane < lanes(); ++lane)
      if (const int x = came().x + lane; at_end || x == 0 || x == grid.x - 1)
        word(kHere, lane).beside_wall = 1;
  }

  const bool counts_axes_, finds_walls_;
};

}  // namespace voxmelt::hwmodel
