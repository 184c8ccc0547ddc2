// Convection: warmer liquid below gives heat to colder liquid above. The cell above comes right after.
#include <cstdint>
#include <memory>
#include <vector>

#include "hwmodel/stream/heat_word.h"
#include "hwmodel/stream/stages.h"

namespace voxmelt::hwmodel {
namespace {

class Convection final : public Stage {
 public:
  explicit Convection(const Design& design)
      : Stage("convection", "heat", design, 1),
        material_(design.parameters.material),
        weight_(design.parameters.heat.convection),
        line_(lanes(), 1) {}

  int output_bits() const override { return heated_cell_bits(design()); }
  std::vector<BufferCost> buffers() const override {
    return {{"token register", 1, lanes(), heat_word_bits(design(), 2)}};
  }
  Units units() const override { return {.multipliers = 1}; }

 private:
  void begin_step() override { dither_ = dither_of(step()); }

  void advance(const Cell* in, Cell* out) override {
    line_.shift();
    HeatWord *above = line_.tap(0), *below = line_.tap(1);
    if (in != nullptr) {
      for (int lane = 0; lane < lanes(); ++lane) take_cell(in[lane], material_, above[lane]);
      for (int lane = 0; lane < lanes() && came().y > 0; ++lane) rise(below[lane], above[lane], lane);
    }
    if (out == nullptr) return;
    for (int lane = 0; lane < lanes(); ++lane) out[lane] = give_cell(below[lane], below[lane].exposed);
  }

  void rise(HeatWord& below, HeatWord& above, int lane) {
    if (!below.liquid() || !above.liquid()) return;
    const SInt<17> drop = std::int64_t{below.temperature} - above.temperature;
    if (drop > 0) {
      move(below, above, scale(drop, weight_, dither_));
    } else if (drop < 0 && armed(Fault::convection_downwards)) [[unlikely]] {
      const std::int64_t flow = scale(-drop, weight_, dither_);
      const std::int64_t left = below.heat - flow;
      if (flow == 0 || left < 0 || above.heat + flow > kHeatMax) return;
      if (!survives_exchange(design().parameters.heat, below, below.heat, left)) return;
      move(below, above, flow);
      strike(came().x + lane, came().y - 1, came().z);
    }
  }

  static void move(HeatWord& from, HeatWord& to, std::int64_t flow) {
    from.heat = from.heat - flow;
    to.heat = to.heat + flow;
  }

  const rule::Material material_;
  const std::int64_t weight_;
  UInt<16> dither_;
  TapLine<HeatWord> line_;
};

}  // namespace

std::unique_ptr<Stage> make_convection(const Design& design) { return std::make_unique<Convection>(design); }

}  // namespace voxmelt::hwmodel
