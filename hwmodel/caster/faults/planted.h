// The parts of the fault policy share a base. It says if their fault is armed, and records where it strikes.
// It also reads levels and columns as they lie in memory, because a fault may need to know what is right.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/caster/model/field.h"
#include "hwmodel/caster/model/ground.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/registers.h"
#include "hwmodel/caster/model/tokens.h"

namespace voxmelt::hwmodel::raycast {

class Planted : public check::Planted<FaultPlan> {
 public:
  Planted(FaultPlan& plan, const Registers& registers, const Memory& memory)
      : check::Planted<FaultPlan>(plan), registers_(&registers), memory_(&memory) {}

 protected:
  bool armed(Fault fault) const { return plan().armed(fault); }
  void strike(const char* stage, const RayId& id) { plan().strike({stage, id.x, id.y, id.sample}); }
  // Strikes if the wrong value is another one.
  template <class Value>
  void replace(const char* stage, const RayId& id, Value& value, const Value& wrong) {
    if (wrong == value) return;
    value = wrong;
    strike(stage, id);
  }

  const Registers& registers() const { return *registers_; }
  const Memory& memory() const { return *memory_; }

  // Returns the sample at a position of the lattice, without cache or pipe.
  std::int64_t level_at(Vec q) const {
    const Vec &low = registers_->skip.low, &high = registers_->skip.high;
    if (q.x < low.x || q.y < low.y || q.z < low.z || q.x >= high.x || q.y >= high.y || q.z >= high.z)
      return kAir;
    LevelRequest request;
    request.at = q;
    const Places places = request.places();
    std::array<std::int16_t, 8> words{};
    for (std::size_t i = 0; i < 8; ++i)
      words[i] = word_at(places.x[i & 1], places.y[i >> 1 & 1], places.z[i >> 2], places.low);
    return sample_of(words.data(), q);
  }
  // Says if a place is in the slab, between its four columns.
  bool in_ground(Vec p) const {
    const Layout& layout = memory_->heights;
    const Spot x = spot_of(p.x), z = spot_of(p.z);
    const auto height = [&](std::size_t n) {
      const auto inside = [](std::int64_t cell, std::int64_t cells) {
        return static_cast<int>(std::clamp<std::int64_t>(cell, 0, cells - 1));
      };
      const int cx = inside(x.cell + (n & 1), registers_->cells.x);
      const int cz = inside(z.cell + (n >> 1), registers_->cells.z);
      Column column;
      std::memcpy(&column,
                  memory_->bytes.data() +
                      layout.address(layout.line_at(cx >> layout.bits[0], 0, cz >> layout.bits[2])) +
                      layout.offset(cx, 0, cz),
                  sizeof column);
      return std::int64_t{column.drawn};
    };
    return (p.y >> 8) < between_columns(height, x, z);
  }

 private:
  std::int16_t word_at(int x, int y, int z, const std::array<std::int32_t, 3>& low) const {
    const Layout& layout = memory_->levels;
    const int bx = low[0] >> kBrickBits, by = low[1] >> kBrickBits, bz = low[2] >> kBrickBits;
    const std::int64_t line =
        layout.apron ? layout.line_at(bx, by, bz)
                     : layout.line_at(x >> layout.bits[0], y >> layout.bits[1], z >> layout.bits[2]);
    if (line == kNoLine) return kAir;
    std::int16_t word = 0;
    const int offset = layout.apron ? layout.apron_offset(x, y, z, bx, by, bz) : layout.offset(x, y, z);
    std::memcpy(&word, memory_->bytes.data() + layout.address(line) + offset, sizeof word);
    return word;
  }

  const Registers* registers_;
  const Memory* memory_;
};

}  // namespace voxmelt::hwmodel::raycast
