// A caster follows rays. Every caster gives the answers of rule::VoxelWalk, which tell if a ray sees its
// source.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/engine/visibility/gaps.h"
#include "kernel/engine/visibility/opaque.h"

namespace voxmelt::visibility {

// Runs from a face of a solid cell to a point of its source. `cell` lies beyond the face, and is not opaque.
// It may lie outside the grid.
struct Ray {
  Cell cell;
  rule::Position start, end;
};

// Tells the fate of a ray. It sees the source, or it meets the opaque cell at this place (Opaque::place). Any
// opaque cell on its way will do. If places exceed 32 bits, it is only known to be dark. No caster gives
// kNone. Code that keeps fates uses it if there is no ray to cast.
using Fate = std::uint32_t;
inline constexpr Fate kSees = 0xffff'ffff, kDark = 0xffff'fffe, kNone = 0xffff'fffd;
inline Fate met(std::size_t place) { return place < kNone ? static_cast<Fate>(place) : kDark; }

class Caster {
 public:
  virtual ~Caster() = default;
  virtual std::string_view name() const = 0;
  // Is called before rays are cast into a new state of `opaque`, which is the same object every time.
  virtual void prepare(const Opaque& /*opaque*/, const Opaque::News& /*news*/) {}
  // Finds one fate for each ray. Several threads may call it at once.
  virtual void cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const = 0;
};

// Uses rule::VoxelWalk itself, cell after cell.
class PlainCaster final : public Caster {
 public:
  std::string_view name() const override { return "walk"; }
  void cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const override;
};

// Returns the fate of one ray, found by bricks.
Fate two_level_fate(const Opaque& opaque, const Gaps& gaps, const Ray& ray);

// Passes empty gaps at once, and goes from cell to cell elsewhere.
class TwoLevelCaster final : public Caster {
 public:
  std::string_view name() const override { return "two-level"; }
  void prepare(const Opaque& opaque, const Opaque::News& news) override { gaps_.update(opaque, news); }
  void cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const override;

 private:
  Gaps gaps_;
};

}  // namespace voxmelt::visibility
