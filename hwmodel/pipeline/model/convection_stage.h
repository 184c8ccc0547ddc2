// By convection, warmer liquid below gives heat to colder liquid above. The cell above comes directly after
// the one below.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/heat_word.h"
#include "hwmodel/pipeline/model/materials.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

template <class Faults>
class Convection final : public Stage {
 public:
  explicit Convection(const Design& design, Faults faults = {})
      : Stage(StageKind::convection, design, 1),
        faults_(faults),
        curves_(design.parameters),
        weight_(design.parameters.heat.convection),
        line_(lanes(), 1) {}

  Wires side_bands() const override { return heated_bands(design()); }
  std::vector<BufferCost> buffers() const override {
    return {{"token register", 1, lanes(), heat_word_bits(design(), 2)}};
  }
  Units units() const override { return {.multipliers = 1}; }

 private:
  friend Faults;

  void begin_step() override { dither_ = dither_of(step()); }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    HeatWord *above = line_.tap(0), *below = line_.tap(1);
    if (in != nullptr) {
      for (const int lane : each_lane())  // only liquid counts
        take_cell(in[lane], curves_.temperature(in[lane].heat), above[lane]);
      if (came().y > 0)
        for (const int lane : each_lane()) rise(below[lane], above[lane]);
    }
    if (out == nullptr) return;
    for (int lane = 0; lane < lanes(); ++lane) out[lane] = give_cell(below[lane], below[lane].exposed);
  }

  void rise(HeatWord& below, HeatWord& above) {
    if (!below.liquid() || !above.liquid()) return;
    const SInt<17> drop = std::int64_t{below.temperature} - above.temperature;
    if (drop <= 0) return faults_.rested(*this, below, above);
    move(below, above, scale(drop, weight_, dither_));
  }

  static void move(HeatWord& from, HeatWord& to, std::int64_t flow) {
    from.heat = from.heat - flow;
    to.heat = to.heat + flow;
  }

  [[no_unique_address]] Faults faults_;
  const Curves curves_;
  const std::int64_t weight_;
  UInt<16> dither_;
  TapLine<HeatWord> line_;
};

}  // namespace voxmelt::hwmodel
