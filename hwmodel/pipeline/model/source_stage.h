// Vents add liquid, and drains take it away. All open ones act on a cell, one after another, while it passes.
// An open border is the last drain. It takes all that a cell of it holds, and compares where a ball squares.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// Describes a vent or a drain that is open in this step.
struct Opening {
  rule::Region region;
  bool vent;
  UInt<16> rate, temperature;
  UInt<13> energy;  // per kOne of amount
  // Gives the greatest squared distance along x that is reached at the token's height and depth.
  // That of the border is 0 where the token has cells of it, and -1 elsewhere.
  std::int64_t reach2 = 0;
  bool border = false;
};

template <class Faults>
class Source final : public Stage {
 public:
  explicit Source(const Design& design, Faults faults = {})
      : Stage(StageKind::source, design, 0), faults_(faults), paper_(design.paper()), hot_(design.hot()) {
    open_.reserve(design.parameters.vents.size() + design.parameters.drains.size() + 1);
  }

  // Each opening squares the distance along x. A vent also has energy, two products and the dither of the
  // mixture.
  Units units() const override {
    const int vents = static_cast<int>(design().parameters.vents.size());
    const int drains = static_cast<int>(design().parameters.drains.size());
    return {.multipliers = vents * (1 + (paper_ ? 1 : 0) + (hot_ ? 3 : 0)) + drains,
            .dividers = hot_ ? vents : 0};
  }

 private:
  friend Faults;

  void begin_step() override {
    dither_ = dither_of(step());
    open_.clear();
    for (const rule::Vent& vent : design().parameters.vents)
      if (vent.from <= step() && step() < vent.until)
        open_.push_back({vent.region, true, vent.rate, vent.temperature, vent.energy});
    for (const rule::Drain& drain : design().parameters.drains)
      if (drain.from <= step() && step() < drain.until)
        open_.push_back({drain.region, false, drain.rate, 0, 0});
    if (design().parameters.open_border) open_.push_back({{}, false, kAmountMax, 0, 0, 0, true});
  }

  void advance(const Cell* in, Cell* out) override {
    std::copy_n(in, lanes(), out);
    bool any = false;
    for (Opening& opening : open_) {
      opening.reach2 = opening.border ? border_reach() : ball_reach(opening.region);
      any |= opening.reach2 >= 0;
    }
    if (!any) return;
    for (const int lane : each_lane()) {
      if (in[lane].blocked()) continue;
      out[lane] = treated(in[lane], lane);
      faults_.treated(*this, in[lane], lane, out[lane]);
    }
  }

  std::int64_t ball_reach(const rule::Region& ball) const {
    return ball.radius * ball.radius - square(came().y, ball.at.y) - square(came().z, ball.at.z);
  }

  bool outermost_plane() const { return came().z == 0 || came().z == shape().grid.z - 1; }
  std::int64_t border_reach() const {
    return outermost_plane() || came().x == 0 || came().x + lanes() >= shape().grid.x ? 0 : -1;
  }

  // Returns the square of the distance along one axis, in sixteenths of a cell, from a cell's centre.
  static std::int64_t square(int cell, std::int64_t at) {
    const SInt<26> distance = 16 * std::int64_t{cell} + 8 - at;
    return distance * distance;
  }

  Cell treated(Cell cell, int lane) const {
    for (const Opening& opening : open_) {
      if (!reaches(opening, lane)) continue;
      opening.vent ? vent(opening, cell) : drain(opening, cell);
    }
    cell.settle_state();
    return cell;
  }

  bool reaches(const Opening& opening, int lane) const {
    return opening.reach2 >= 0 && covers(opening, came().x + lane);
  }

  // Tells if an opening that reaches the token's height and depth has the cell at x.
  bool covers(const Opening& opening, int x) const {
    if (opening.border) return outermost_plane() || x == 0 || x == shape().grid.x - 1;
    return square(x, opening.region.at.x) <= opening.reach2;
  }

  void vent(const Opening& opening, Cell& cell) const {
    const UInt<16> before = cell.amount;
    const UInt<16> added = std::min<std::int64_t>(opening.rate, kAmountMax - before);
    if (added == 0) return;
    cell.amount = before + added;
    if (paper_) cell.energy = cell.energy + ((added * opening.energy) >> 12);
    if (!hot_) return;
    const UInt<32> content = before * cell.heat + added * opening.temperature;
    cell.heat = mix(content, cell.amount, dither_);
  }

  static void drain(const Opening& opening, Cell& cell) {
    const UInt<16> left = cell.amount - std::min<std::int64_t>(opening.rate, cell.amount);
    cell.energy = std::min<std::int64_t>(cell.energy, left);
    cell.amount = left;
  }

  [[no_unique_address]] Faults faults_;
  const bool paper_, hot_;
  UInt<16> dither_;
  std::vector<Opening> open_;
};

}  // namespace voxmelt::hwmodel
