// Heat is conducted through faces. The six face neighbours also tell the exposed axes of each cell, for the
// exchange with air. They tell, too, if one of its four sides is blocked, for gravity, and if one of all six
// is, for what freezes.
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
      : Pass(StageKind::conduction, design,
             {design.parameters, design.parameters.heat.weight_face, &rule::SolidMaterial::weight_face},
             faults),
        counts_axes_(design.parameters.heat.air),
        finds_walls_(design.walls_in_conduction()),
        finds_touched_(design.freezes()) {}

  std::vector<BufferCost> buffers() const override { return this->buffers_of(3); }

 private:
  void watch() override {
    if (counts_axes_) {
      expose<0>();
      expose<1>();
      expose<2>();
    }
    if (finds_walls_ || finds_touched_) find_blocked();
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

  // Finds the cells beside which something blocked stands, at the four sides or at all six. Nothing melts or
  // freezes before the phase melt, so the masks are those of its begin.
  void find_blocked() {
    const auto touch = [this](HeatWord& p, HeatWord& q) {
      if (p.blocked()) stand_beside(q);
      if (q.blocked()) stand_beside(p);
    };
    each_pair(part<0>, touch);
    each_pair(part<2>, touch);
    const state::Grid& grid = shape().grid;
    const bool at_end = came().z == 0 || came().z == grid.z - 1;  // the border is blocked
    for (int lane = 0; lane < lanes(); ++lane)
      if (const int x = came().x + lane; at_end || x == 0 || x == grid.x - 1) stand_beside(word(kHere, lane));
    if (finds_touched_) find_upright();
  }

  void stand_beside(HeatWord& cell) const {
    cell.beside_wall = finds_walls_;
    cell.touches = finds_touched_;
  }

  void find_upright() {
    each_pair(part<1>, [](HeatWord& p, HeatWord& q) {
      if (p.blocked()) q.touches = 1;
      if (q.blocked()) p.touches = 1;
    });
    if (came().y > 0 && came().y < shape().grid.y - 1) return;
    for (int lane = 0; lane < lanes(); ++lane) word(kHere, lane).touches = 1;
  }

  const bool counts_axes_, finds_walls_, finds_touched_;
};

}  // namespace voxmelt::hwmodel
