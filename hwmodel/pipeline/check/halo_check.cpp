#include "hwmodel/pipeline/check/halo_check.h"

#include <string>

#include "hwmodel/pipeline/model/shape.h"
#include "hwmodel/pipeline/model/tiling.h"

namespace voxmelt::hwmodel {
namespace {

std::unique_ptr<Mismatch> at_cut(const Design& design, int tile, int owned, int needed, int held) {
  return std::make_unique<Mismatch>(
      Mismatch{.kind = Mismatch::Kind::halo,
               .where = "tiles",
               .lane = owned % design.shape.lanes,
               .x = owned,
               .field = "cells of halo",
               .expected = needed,
               .actual = held,
               .detail = "tile " + std::to_string(tile) + " owns this column, and it depends on " +
                         std::to_string(needed) + " cells beside it; the tile has " + std::to_string(held)});
}

// The halo follows from what the stages say that they reach. So that is compared in every run, cut or not.
std::unique_ptr<Mismatch> short_reach(const Design& design) {
  const int needed = dependence_of_step(design), said = reach_of_step(design);
  if (said >= needed) return nullptr;
  return std::make_unique<Mismatch>(Mismatch{
      .kind = Mismatch::Kind::halo,
      .where = "tiles",
      .field = "cells that a step reaches",
      .expected = needed,
      .actual = said,
      .detail = "a cell depends on " + std::to_string(needed) +
                " cells beside it in a step; the stages say that they reach " + std::to_string(said)});
}

}  // namespace

int dependence_of_step(const Design& design) {
  const rule::Parameters& p = design.parameters;
  // Section 6: conduction takes a synchronous pass for faces, one for edges and one for corners. The sides
  // of a cell before them (sections 7 and 8) lie as near as its faces.
  int cells = 0;
  if (design.hot()) cells += p.heat.neighbours == 26 ? 3 : p.heat.neighbours == 18 ? 2 : 1;
  // Section 9: a cell gives by what its neighbours hold, and gets what they give.
  if (p.flow.law == rule::Law::paper) return cells + 2 + (!design.hot() && design.needs_walls() ? 1 : 0);
  // Section 11: each sub-step exchanges with the eight neighbours. Sides are those of the same state.
  return cells + design.substeps;
}

std::unique_ptr<Mismatch> narrow_halo(const Design& design, int steps) {
  if (auto short_one = short_reach(design)) return short_one;
  const Shape& shape = design.shape;
  const int needed = steps * dependence_of_step(design);
  for (int tile = 0; tile < shape.tiles(); ++tile) {
    const int left = shape.first_block(tile) * shape.lanes, end = left + shape.blocks() * shape.lanes;
    const int first = shape.owned_begin(tile) * shape.lanes, last = shape.owned_end(tile) * shape.lanes;
    if (left > 0 && first - left < needed) return at_cut(design, tile, first, needed, first - left);
    if (end < shape.grid.x && end - last < needed) return at_cut(design, tile, last - 1, needed, end - last);
  }
  return nullptr;
}

}  // namespace voxmelt::hwmodel
