// One pass of conduction (Eq. 1): all pairs of one neighbour distance. When a cell comes, the fluxes of those
// pairs are computed whose smallest box of cells it closes, so that each pair is computed once, and both
// partners are updated where they stand in the line.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hwmodel/stream/heat_word.h"

namespace voxmelt::hwmodel {

// A corner of the 2 x 2 x 2 window: steps back from the cell that comes.
enum Corner : unsigned { kHere = 0, kWest = 1, kBelow = 2, kSouth = 4 };

// Two cells of the window, q = p + axis. Which is which matters: the floor is not symmetric.
struct HeatPair {
  unsigned p, q;
};

// In the order of section 6, which gives the dither.
inline constexpr std::array<HeatPair, 3> kFacePairs{{{kWest, kHere}, {kBelow, kHere}, {kSouth, kHere}}};
inline constexpr std::array<HeatPair, 6> kEdgePairs{{{kWest | kBelow, kHere},
                                                     {kWest, kBelow},
                                                     {kWest | kSouth, kHere},
                                                     {kWest, kSouth},
                                                     {kBelow | kSouth, kHere},
                                                     {kBelow, kSouth}}};
inline constexpr std::array<HeatPair, 4> kCornerPairs{{{kWest | kBelow | kSouth, kHere},
                                                       {kWest | kBelow, kSouth},
                                                       {kWest | kSouth, kBelow},
                                                       {kWest, kBelow | kSouth}}};

inline std::int64_t corner_delay(const Shape& shape, unsigned corner) {
  return (corner & kWest ? shape.column() : 0) + (corner & kBelow ? 1 : 0) +
         (corner & kSouth ? shape.plane() : 0);
}

// Where the line has taps, ascending; the last one is where words leave.
std::vector<std::int64_t> tap_delays(const Shape& shape, std::span<const HeatPair> pairs);
// The memories between them.
std::vector<BufferCost> heat_buffers(const Design& design, std::span<const HeatPair> pairs, int exposed_bits);

template <const auto& kPairs>
class ConductionPass : public Stage {
 public:
  static constexpr std::size_t kParts = kPairs.size();

  // `weight`: of this distance. `last`: no other pass of conduction follows.
  ConductionPass(std::string name, const Design& design, std::uint16_t weight, bool last)
      : Stage(std::move(name), "heat", design, tap_delays(design.shape, kPairs).back()),
        material_(design.parameters.material),
        weight_(weight),
        last_(last),
        line_(lanes(), static_cast<std::size_t>(lag())) {}

  int output_bits() const override { return heated_cell_bits(design()); }
  std::vector<BufferCost> buffers() const override { return heat_buffers(design(), kPairs, 2); }
  Units units() const override { return {.multipliers = static_cast<int>(kParts)}; }

 protected:
  void begin_step() override {
    for (std::size_t part = 0; part < kParts; ++part)
      dither_[part] = dither_of(step(), static_cast<int>(part), static_cast<int>(kParts));
  }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    for (unsigned corner = 0; corner < rows_.size(); ++corner) {
      const std::int64_t delay = corner_delay(shape(), corner);
      rows_[corner] = delay <= lag() ? line_.tap(static_cast<std::size_t>(delay)) : nullptr;
    }
    if (in != nullptr) {
      for (int lane = 0; lane < lanes(); ++lane) take_cell(in[lane], material_, rows_[kHere][lane]);
      conduct(std::make_index_sequence<kParts>());
      watch();
      if (last_ && conduction_fault_armed()) [[unlikely]]
        misbehave();
    }
    if (out == nullptr) return;
    const HeatWord* oldest = line_.tap(line_.delay());
    for (int lane = 0; lane < lanes(); ++lane)
      out[lane] = give_cell(oldest[lane], exposed_axes(oldest[lane]));
  }

  virtual void watch() {}  // what else a pass has to see in the window
  virtual std::int64_t exposed_axes(const HeatWord& word) const { return word.exposed; }

  // Calls visit(p, q) for the pairs of one axis that the token that comes closes.
  template <std::size_t kPart, class Visit>
  void each_pair(Visit&& visit) {
    constexpr unsigned p = kPairs[kPart].p, q = kPairs[kPart].q, span = p | q;
    if ((span & kBelow) != 0 && came().y == 0) return;
    if ((span & kSouth) != 0 && came().z == 0) return;
    if (came().x > 0 || (span & kWest) == 0) visit(word(p, 0), word(q, 0));
    HeatWord *ps = rows_[p & ~kWest], *qs = rows_[q & ~kWest];
    constexpr int p_west = (p & kWest) != 0, q_west = (q & kWest) != 0;
    for (int lane = 1; lane < lanes(); ++lane) visit(ps[lane - p_west], qs[lane - q_west]);
  }

  // The word in a corner of a lane's window.
  HeatWord& word(unsigned corner, int lane) {
    if ((corner & kWest) == 0) return rows_[corner][lane];
    return lane == 0 ? rows_[corner][lanes() - 1] : rows_[corner & ~kWest][lane - 1];
  }

  const rule::Material material_;

 private:
  // What flows from q to p.
  std::int64_t flux(const HeatWord& p, const HeatWord& q, std::int64_t dither) const {
    if (!p.matter() || !q.matter()) return 0;
    return scale(std::int64_t{q.temperature} - p.temperature, weight_, dither);
  }

  template <std::size_t... kPart>
  void conduct(std::index_sequence<kPart...>) {
    const auto exchange = [this](std::int64_t dither) {
      return [this, dither](HeatWord& p, HeatWord& q) {
        const std::int64_t flow = flux(p, q, dither);
        if (flow == 0) return;
        p.heat = p.heat + flow;
        q.heat = q.heat - flow;
      };
    };
    (each_pair<kPart>(exchange(dither_[kPart])), ...);
  }

  bool conduction_fault_armed() const {
    return armed(Fault::conduction_sign) || armed(Fault::conduction_dither) ||
           armed(Fault::conduction_stale_row) || (kParts > 3 && armed(Fault::distant_wrong_axis));
  }

  // Is the pair with the cell that comes the last of the cell p? Only then is it known what p will be.
  bool completes(unsigned p, int lane) const {
    switch (p) {
      case kSouth:
        return true;
      case kSouth | kWest:
        return kParts == 6 && lane == 0;
      case kSouth | kBelow:
        return kParts == 6 && lane + 1 < lanes();
      case kSouth | kWest | kBelow:
        return true;
      default:
        return false;
    }
  }

  std::int64_t wrong_flux(std::size_t part, int lane) {
    const unsigned corner = kPairs[part].p;
    const HeatWord &p = word(corner, lane), &q = word(kHere, lane);
    if (armed(Fault::conduction_sign)) return -flux(p, q, dither_[part]);
    if (armed(Fault::conduction_dither)) return flux(p, q, dither_[(part + 1) % kParts]);
    if (armed(Fault::conduction_stale_row)) {
      const bool same_token = lane > 0 && (corner & kWest) != 0;
      const std::int64_t delay = corner_delay(shape(), same_token ? corner & ~kWest : corner);
      const HeatWord* row = line_.tap(static_cast<std::size_t>(delay - 1));
      return flux(row[(corner & kWest) == 0 ? lane : (lane + lanes() - 1) % lanes()], q, dither_[part]);
    }
    return flux(p, came().y > 0 ? word(kBelow, lane) : q, dither_[part]);
  }

  // Lets the planted fault strike the part of a flux that goes to the cell in the plane before. It may only
  // do so where that cell is the first one in the stream that the end of the phase shows wrong: where no
  // later pass carries the error to a cell before it, and the exchange does not hide it.
  void misbehave() {
    const rule::Heat& heat = design().parameters.heat;
    if (came().z == 0) return;
    for (int lane = 0; lane < lanes(); ++lane)
      for (std::size_t part = 0; part < kParts; ++part) {
        const HeatPair pair = kPairs[part];
        if (pair.q != kHere || !completes(pair.p, lane)) continue;
        const int x = came().x + lane - ((pair.p & kWest) != 0), y = came().y - ((pair.p & kBelow) != 0);
        if (x < 0 || y < 0) continue;
        HeatWord& p = word(pair.p, lane);
        const HeatWord& q = word(kHere, lane);
        if (!p.matter() || !q.matter() || (heat.convection > 0 && p.liquid())) continue;
        const std::int64_t right = p.heat, wrong = right - flux(p, q, dither_[part]) + wrong_flux(part, lane);
        if (wrong == right || wrong < 0 || wrong > kHeatMax || !survives_exchange(heat, p, right, wrong))
          continue;
        p.heat = wrong;
        strike(x, y, came().z - 1);
        return;
      }
  }

  const std::uint16_t weight_;
  const bool last_;
  std::array<UInt<16>, kParts> dither_;
  TapLine<HeatWord> line_;
  std::array<HeatWord*, 8> rows_{};
};

}  // namespace voxmelt::hwmodel
