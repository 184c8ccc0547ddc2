// Solids may be of several materials (docs/automaton.md, section 6). The host fills tables before a run with
// what rules need to know of each. Each place that reads a table has a copy of it. A scene of one material
// has tables of one row, which are constants.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/arithmetic.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// Knows the temperatures of heat contents, and what it takes to melt.
class Curves {
 public:
  static constexpr int kBits = 17 + 16 + 16;  // of a row: warmth, melting point, what is beyond it
  struct Curve {
    UInt<17> warmth = 65536;
    UInt<16> melting_point, beyond;
    UInt<17> as_first;  // heat of the first material at this one's melting point, when liquid
  };

  explicit Curves(const rule::Parameters& parameters);

  // This takes one product where there are several materials.
  UInt<16> temperature(std::int64_t h, std::int64_t material) const {
    const Curve& curve = looked_up(curves_, material);
    const UInt<16> warm = UInt<32>(h * curve.warmth) >> 16;
    const std::int64_t later = std::max<std::int64_t>(curve.melting_point, h - curve.beyond);
    return std::min<std::int64_t>({top_, warm, later});
  }
  // Returns that of liquid, and of an isothermal wall. The warmth of the first material is 1.
  UInt<16> temperature(std::int64_t h) const {
    const Curve& curve = curves_.front();
    return std::min<std::int64_t>({top_, h, std::max<std::int64_t>(curve.melting_point, h - curve.beyond)});
  }
  // Returns the heat from which on a material is liquid.
  UInt<16> liquid_from(std::int64_t material) const {
    const Curve& curve = looked_up(curves_, material);
    return curve.melting_point + curve.beyond;
  }
  // Returns the heat of the first material that is as warm as a solid that has just melted.
  UInt<16> melted(std::int64_t h, std::int64_t material) const {
    if (material == 0) return h;
    const UInt<16> after = h - liquid_from(material);
    return std::min<std::int64_t>(kHeatMax, after + std::int64_t{looked_up(curves_, material).as_first});
  }
  const std::vector<Curve>& rows() const { return curves_; }
  std::int64_t top() const { return top_; }  // no temperature is beyond it

 private:
  std::vector<Curve> curves_;
  UInt<16> top_ = kHeatMax;
};

// Holds the weights of the pairs of one neighbour distance. A pair has the same weight both ways, so half of
// the table suffices: up to 136 words.
class PairWeights {
 public:
  using Row = rule::SolidMaterial::Weights rule::SolidMaterial::*;

  // `only` is the weight where there is one material, `row` where there are several.
  PairWeights(const rule::Parameters& parameters, std::uint16_t only, Row row);

  std::int64_t of(std::int64_t one, std::int64_t other) const {
    const auto [low, high] = std::minmax(one, other);
    return looked_up(words_, high * (high + 1) / 2 + low);
  }
  std::int64_t words() const { return static_cast<std::int64_t>(words_.size()); }

 private:
  std::vector<UInt<16>> words_;
};

// Returns the table with `bits` for each material, which every lane reads at so many places. One material has
// none.
inline void add_table(std::vector<BufferCost>& buffers, const char* name, const Design& design, int bits,
                      int places = 1) {
  if (design.of_materials() && places > 0)
    buffers.push_back({name, design.materials(), std::int64_t{design.shape.lanes} * places, bits});
}

}  // namespace voxmelt::hwmodel
