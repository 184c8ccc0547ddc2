// One pass of conduction (Eq. 1) treats all pairs of one neighbour distance. The cell that comes completes
// the smallest box of cells around some pairs, and their fluxes are computed then. So each pair is computed
// once, and both partners are updated where they are in the line. An isothermal wall is a partner that stays
// as it is.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/heat_word.h"
#include "hwmodel/pipeline/model/materials.h"

namespace voxmelt::hwmodel {

// Names a corner of the 2 x 2 x 2 window by its steps back from the cell that comes.
enum Corner : unsigned { kHere = 0, kWest = 1, kBelow = 2, kSouth = 4 };

// Names two cells of the window, q = p + axis. Their order matters, because rounding down is not symmetric.
struct HeatPair {
  unsigned p, q;
};

// The pairs stand in the order of docs/automaton.md, section 6, which gives the dither.
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

// Returns the taps of the line, ascending. Words leave at the last one.
std::vector<std::int64_t> tap_delays(const Shape& shape, std::span<const HeatPair> pairs);
// Returns the memories between the taps.
std::vector<BufferCost> heat_buffers(const Design& design, std::span<const HeatPair> pairs, int exposed_bits);
// Adds the tables of a pass, where there are several materials. Each pair of a lane reads weights at once.
void add_material_tables(const Design& design, std::span<const HeatPair> pairs, std::int64_t words,
                         std::vector<BufferCost>& buffers);

// Makes a number a type. It is the part of the dither that the pairs of one axis use.
template <std::size_t kPart>
inline constexpr std::integral_constant<std::size_t, kPart> part{};

template <const auto& kPairs, class Faults>
class ConductionPass : public Stage {
 public:
  static constexpr int kParts = kPairs.size();

  // `weights` are those of this neighbour distance.
  ConductionPass(StageKind kind, const Design& design, PairWeights weights, Faults faults)
      : Stage(kind, design, tap_delays(design.shape, kPairs).back()),
        curves_(design.parameters),
        faults_(faults),
        weights_(std::move(weights)),
        line_(lanes(), lag()) {}

  Wires side_bands() const override { return heated_bands(design()); }
  std::vector<BufferCost> buffers() const override { return buffers_of(2); }
  // Each pair multiplies. So does the temperature of the cell that comes, where there are several materials.
  Units units() const override { return {.multipliers = kParts + (design().of_materials() ? 1 : 0)}; }

 protected:
  void begin_step() override {
    for (int part = 0; part < kParts; ++part) dither_[part] = dither_of(step(), part, kParts);
  }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    for (unsigned corner = 0; corner < rows_.size(); ++corner) {
      const std::int64_t delay = corner_delay(shape(), corner);
      rows_[corner] = delay <= lag() ? line_.tap(delay) : nullptr;
    }
    if (in != nullptr) {
      for (const int lane : each_lane())
        take_cell(in[lane], curves_.temperature(in[lane].heat, in[lane].material), rows_[kHere][lane]);
      conduct(std::make_index_sequence<kParts>());
      watch();
      faults_.conducted(*this);
    }
    if (out == nullptr) return;
    const HeatWord* oldest = line_.tap(line_.delay());
    for (const int lane : each_lane(lag())) {
      out[lane] = give_cell(oldest[lane], exposed_axes(oldest[lane]));
      faults_.gave(*this, oldest[lane], lane, out[lane]);
    }
  }

  virtual void watch() {}  // hook for what else a pass must see in the window
  virtual std::int64_t exposed_axes(const HeatWord& word) const { return word.exposed; }
  std::vector<BufferCost> buffers_of(int exposed_bits) const {
    std::vector<BufferCost> buffers = heat_buffers(design(), kPairs, exposed_bits);
    add_material_tables(design(), kPairs, weights_.words(), buffers);
    return buffers;
  }

  // Calls visit(p, q) for the pairs of one axis that the arriving token completes.
  template <std::size_t kPart, class Visit>
  void each_pair(std::integral_constant<std::size_t, kPart> /*part*/, Visit&& visit) {
    constexpr unsigned p = kPairs[kPart].p, q = kPairs[kPart].q, span = p | q;
    if ((span & kBelow) != 0 && came().y == 0) return;
    if ((span & kSouth) != 0 && came().z == 0) return;
    compute_at(0, 0);
    if (came().has_west() || (span & kWest) == 0) visit(word(p, 0), word(q, 0));
    HeatWord *ps = rows_[p & ~kWest], *qs = rows_[q & ~kWest];
    constexpr int p_west = (p & kWest) != 0, q_west = (q & kWest) != 0;
    for (int lane = 1; lane < lanes(); ++lane) {
      compute_at(0, lane);
      visit(ps[lane - p_west], qs[lane - q_west]);
    }
  }

  // Returns the word in a corner of a lane's window.
  HeatWord& word(unsigned corner, int lane) {
    if ((corner & kWest) == 0) return rows_[corner][lane];
    return lane == 0 ? rows_[corner][lanes() - 1] : rows_[corner & ~kWest][lane - 1];
  }

  const Curves curves_;

 private:
  friend Faults;

  // Returns the flow from q to p.
  std::int64_t flux(const HeatWord& p, const HeatWord& q, std::int64_t dither) const {
    if (!p.conducts() || !q.conducts()) return 0;
    return scale(std::int64_t{q.temperature} - p.temperature, weight(p, q), dither);
  }
  // A wall counts as being of its neighbour's material.
  std::int64_t weight(const HeatWord& p, const HeatWord& q) const {
    return weights_.of(p.matter() ? p.material : q.material, q.matter() ? q.material : p.material);
  }

  template <std::size_t... kPart>
  void conduct(std::index_sequence<kPart...>) {
    const auto exchange = [this](std::int64_t dither) {
      return [this, dither](HeatWord& p, HeatWord& q) {
        const std::int64_t flow = flux(p, q, dither);
        if (flow == 0) return;
        if (p.matter()) p.heat = p.heat + flow;
        if (q.matter()) q.heat = q.heat - flow;
      };
    };
    (each_pair(part<kPart>, exchange(dither_[kPart])), ...);
  }

  [[no_unique_address]] Faults faults_;
  const PairWeights weights_;
  std::array<UInt<16>, kParts> dither_;
  TapLine<HeatWord> line_;
  std::array<HeatWord*, 8> rows_{};
};

}  // namespace voxmelt::hwmodel
