// Embree casts the rays here. Its tree finds the bricks that a ray may meet, and the integer walk decides in
// each.
//
// A brick of 8x8x8 cells that holds something opaque is a box, around its opaque cells and 0.02 cells wider.
// So rounding in Embree's floats hides no brick that the exact walk meets. Bricks that it finds in excess are
// refused by the walk. The answers are those of rule::VoxelWalk. Boxes take about 100 bytes each.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <string_view>

#include "kernel/engine/visibility/caster.h"

namespace voxmelt::visibility {

// Tells how many rays are handed to Embree at once.
enum class Packet { one = 1, eight = 8, sixteen = 16 };

class EmbreeCaster final : public Caster {
 public:
  explicit EmbreeCaster(Packet packet = Packet::eight);
  ~EmbreeCaster() override;
  EmbreeCaster(const EmbreeCaster&) = delete;
  EmbreeCaster& operator=(const EmbreeCaster&) = delete;

  static bool built_in();  // if false, this build has no Embree, and nothing else may be called

  std::string_view name() const override { return "embree"; }
  // Builds the tree anew over the present bricks, or fits it to the rest of the former ones.
  void prepare(const Opaque& opaque, const Opaque::News& news) override;
  void cast(const Opaque& opaque, std::span<const Ray> rays, std::span<Fate> fates) const override;

  struct Box {
    std::array<float, 3> low, high;
  };
  Box box() const;  // bounds all boxes, as the tree has them now

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
  Packet packet_;
};

}  // namespace voxmelt::visibility
