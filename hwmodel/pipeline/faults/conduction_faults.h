// These faults spoil conduction. They strike in the last pass (conduction, edges or corners), and only
// where the cell in the plane before is sure to be wrong at the end of the phase. So the cell is no liquid
// that convects, exchanges no heat with air, and with radiation is far from the hottest. Faults of side bands
// strike in the first pass, which makes them.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "hwmodel/pipeline/faults/heat_survival.h"
#include "hwmodel/pipeline/faults/planted.h"
#include "hwmodel/pipeline/model/conduction_pass.h"

namespace voxmelt::hwmodel {

class ConductionFaults : public Planted {
 public:
  using Planted::Planted;

  template <const auto& kPairs>
  void conducted(ConductionPass<kPairs, ConductionFaults>& pass) {
    if (pass.came().z == 0) return;
    if (pass.kind() == StageKind::conduction && armed(pass, Fault::buffer_bit)) flip_bit(pass);
    if (is_last(pass) && any_armed(pass)) misbehave(pass);
    if (is_last(pass) && armed(pass, Fault::wall_drifts)) drift(pass);
  }

  // Spoils the side bands of the cell that leaves.
  template <const auto& kPairs>
  void gave(const ConductionPass<kPairs, ConductionFaults>& pass, const HeatWord& word, int lane,
            Cell& cell) {
    if (pass.kind() != StageKind::conduction) return;
    miss_side(pass, Fault::side_missed, lane, cell);
    if (cell.touches > 0 && cell.liquid() && pass.leaving().y == 0 && armed(pass, Fault::touch_untold)) {
      cell.touches = 0;
      strike_lane(pass, pass.leaving(), lane);
    }
    const std::int64_t axes = std::popcount<unsigned>(word.exposed & 3);  // axes x and y
    if (axes == cell.exposed_axes || !pass.design().parameters.heat.air ||
        !armed(pass, Fault::axis_uncounted))
      return;
    cell.exposed_axes = axes;
    strike_lane(pass, pass.leaving(), lane);
  }

 private:
  template <const auto& kPairs>
  using Pass = ConductionPass<kPairs, ConductionFaults>;

  static bool is_last(const Stage& pass) {
    const int neighbours = pass.design().parameters.heat.neighbours;
    return pass.kind() == (neighbours >= 26   ? StageKind::corners
                           : neighbours >= 18 ? StageKind::edges
                                              : StageKind::conduction);
  }
  bool any_armed(const Stage& pass) const {
    return armed(pass, Fault::conduction_sign) || armed(pass, Fault::conduction_dither) ||
           armed(pass, Fault::conduction_stale_row) || armed(pass, Fault::conduction_first) ||
           armed(pass, Fault::conduction_mean) ||
           (pass.kind() != StageKind::conduction && armed(pass, Fault::distant_wrong_axis));
  }

  // Sets the lowest bit that is 0 of the amount in the word that leaves the plane memory. A cell's energy may
  // not exceed its amount, so the amount must not shrink.
  template <const auto& kPairs>
  void flip_bit(Pass<kPairs>& pass) {
    for (int lane = 0; lane < pass.lanes(); ++lane) {
      HeatWord& leaves = pass.word(kSouth, lane);
      if (!leaves.matter() || leaves.amount == kAmountMax) continue;
      leaves.amount = leaves.amount | (leaves.amount + 1);
      return strike(pass, pass.came().x + lane, pass.came().y, pass.came().z - 1);
    }
  }

  // Lets the fault strike the part of a flux that goes to the cell in the plane before. It may do so only
  // where that cell is the first one in the stream that is wrong at the end of the phase. Then no later pair
  // carries the error to a cell before it, and the exchange does not hide it.
  template <const auto& kPairs>
  void misbehave(Pass<kPairs>& pass) {
    const rule::Heat& heat = pass.design().parameters.heat;
    const Place& came = pass.came();
    for (int lane = 0; lane < pass.lanes(); ++lane)
      for (std::size_t part = 0; part < kPairs.size(); ++part) {
        const HeatPair pair = kPairs[part];
        if (pair.q != kHere || !completes(pass, pair.p, lane)) continue;
        const int x = came.x + lane - ((pair.p & kWest) != 0), y = came.y - ((pair.p & kBelow) != 0);
        if (x < 0 || y < 0) continue;
        HeatWord& p = pass.word(pair.p, lane);
        const HeatWord& q = pass.word(kHere, lane);
        if (!p.matter() || !q.matter() || (heat.convection > 0 && p.liquid())) continue;
        const std::int64_t right = p.heat;
        const std::int64_t wrong = right - pass.flux(p, q, pass.dither_[part]) + wrong_flux(pass, part, lane);
        if (wrong == right || wrong < 0 || wrong > kHeatMax || !survives_exchange(heat, p, right, wrong))
          continue;
        p.heat = wrong;
        return strike(pass, x, y, came.z - 1);
      }
  }

  // Lets a wall take its part of a flux. The wall is wrong from then on, and nothing else is.
  template <const auto& kPairs>
  void drift(Pass<kPairs>& pass) {
    const Place& came = pass.came();
    for (int lane = 0; lane < pass.lanes(); ++lane)
      for (std::size_t part = 0; part < kPairs.size(); ++part) {
        const HeatPair pair = kPairs[part];
        const int x = came.x + lane - ((pair.p & kWest) != 0), y = came.y - ((pair.p & kBelow) != 0);
        if (pair.q != kHere || x < 0 || y < 0) continue;
        HeatWord& p = pass.word(pair.p, lane);
        const HeatWord& q = pass.word(kHere, lane);
        const std::int64_t flow = p.wall() && q.matter() ? pass.flux(p, q, pass.dither_[part]) : 0;
        const std::int64_t wrong = p.heat + flow;
        if (flow == 0 || wrong <= 0 || wrong > kHeatMax) continue;
        p.heat = wrong;
        return strike(pass, x, y, came.z - ((pair.p & kSouth) != 0));
      }
  }

  // Returns true if the pair with the cell that comes is the last pair of the cell p. Only then is it known
  // what p will be.
  static bool completes(const Stage& pass, unsigned p, int lane) {
    const bool edges = pass.kind() == StageKind::edges;
    switch (p) {
      case kSouth:
        return true;
      case kSouth | kWest:
        return edges && lane == 0;
      case kSouth | kBelow:
        return edges && lane + 1 < pass.lanes();
      case kSouth | kWest | kBelow:
        return true;
      default:
        return false;
    }
  }

  template <const auto& kPairs>
  std::int64_t wrong_flux(Pass<kPairs>& pass, std::size_t part, int lane) {
    const unsigned corner = kPairs[part].p;
    const HeatWord &p = pass.word(corner, lane), &q = pass.word(kHere, lane);
    const auto& dither = pass.dither_;
    if (armed(pass, Fault::conduction_sign)) return -pass.flux(p, q, dither[part]);
    if (armed(pass, Fault::conduction_dither)) return pass.flux(p, q, dither[(part + 1) % kPairs.size()]);
    if (armed(pass, Fault::conduction_first) || armed(pass, Fault::conduction_mean)) {
      const std::int64_t weight = armed(pass, Fault::conduction_first)
                                      ? pass.weights_.of(0, 0)
                                      : (pass.weight(p, p) + pass.weight(q, q)) / 2;
      return scale(std::int64_t{q.temperature} - p.temperature, weight, dither[part]);
    }
    if (armed(pass, Fault::conduction_stale_row)) {
      const bool same_token = lane > 0 && (corner & kWest) != 0;
      const std::int64_t delay = corner_delay(pass.shape(), same_token ? corner & ~kWest : corner);
      const HeatWord* row = pass.line_.tap(delay - 1);
      const int from = (corner & kWest) == 0 ? lane : (lane + pass.lanes() - 1) % pass.lanes();
      return pass.flux(row[from], q, dither[part]);
    }
    return pass.flux(p, pass.came().y > 0 ? pass.word(kBelow, lane) : q, dither[part]);
  }
};

}  // namespace voxmelt::hwmodel
