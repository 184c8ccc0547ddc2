// A batch collects rays that are cast together, and the places of their fates. Most steps have few.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/visibility/caster.h"

namespace voxmelt::visibility {

class RayBatch {
 public:
  RayBatch(const Caster& caster, const Opaque& opaque) : caster_(caster), opaque_(opaque) {}

  // Casts the ray now or with the next `cast`. Until then its fate must stay where it is.
  void add(const Ray& ray, Fate& fate) {
    if (rays_.empty()) {
      rays_.reserve(kMost);
      fates_.reserve(kMost);
    }
    rays_.push_back(ray);
    fates_.push_back(&fate);
    if (rays_.size() == kMost) cast();
  }
  void cast() {
    if (rays_.empty()) return;
    std::array<Fate, kMost> found;
    caster_.cast(opaque_, rays_, {found.data(), rays_.size()});
    for (std::size_t i = 0; i < rays_.size(); ++i) *fates_[i] = found[i];
    count_ += rays_.size();
    rays_.clear();
    fates_.clear();
  }
  std::int64_t count() const { return count_; }  // rays that have been cast

 private:
  static constexpr std::size_t kMost = 1024;

  const Caster& caster_;
  const Opaque& opaque_;
  std::vector<Ray> rays_;
  std::vector<Fate*> fates_;
  std::int64_t count_ = 0;
};

}  // namespace voxmelt::visibility
