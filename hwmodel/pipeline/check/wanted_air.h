// Nine tokens of ten hold nothing but air. Here such tokens are found for a whole plane at once, in the order
// of memory. So their comparison costs one look, and not one for each cell.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/check/expectation.h"
#include "hwmodel/pipeline/model/shape.h"

namespace voxmelt::hwmodel {

class WantedAir {
 public:
  // Returns true if all cells of a token must be air that holds nothing, without any side band. It may return
  // false for such a token, too: then its cells are to be compared one by one.
  bool at(const Expected& expected, const Shape& shape, const Place& place) {
    if (&expected != of_ || place.z != z_ || place.left != left_) look(expected, shape, place);
    return air_[(place.x - left_) / shape.lanes * shape.column() + place.y] != 0;
  }
  void forget() { of_ = nullptr; }

 private:
  void look(const Expected& expected, const Shape& shape, const Place& place);

  // The plane that was looked at last.
  const Expected* of_ = nullptr;
  int z_ = 0, left_ = 0;
  std::vector<std::uint8_t> air_;     // in the order of the stream
  std::vector<std::uint64_t> holds_;  // of one row: a bit for each cell that is not air, or may not be
};

}  // namespace voxmelt::hwmodel
