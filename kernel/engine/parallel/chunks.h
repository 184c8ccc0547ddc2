// Slices are cut into chunks, one task each. In an in-place sweep, cells read the slices beside them, and
// need the old contents of a neighbouring chunk. So the two slices at every cut are saved first.
#pragma once

#include <algorithm>

namespace voxmelt::parallel {

class Chunks {
 public:
  static constexpr int kLeast = 2;  // slices in a chunk; each is beside one cut only

  Chunks() = default;
  Chunks(int slices, int wanted)
      : slices_(slices), count_(std::clamp(slices / kLeast, 1, std::max(1, wanted))) {}

  int count() const { return count_; }
  int cuts() const { return count_ - 1; }
  int begin(int chunk) const { return static_cast<int>(static_cast<long>(slices_) * chunk / count_); }
  int end(int chunk) const { return begin(chunk + 1); }
  int cut(int i) const { return begin(i + 1); }  // between slices cut - 1 and cut

 private:
  int slices_ = 0, count_ = 1;
};

}  // namespace voxmelt::parallel
