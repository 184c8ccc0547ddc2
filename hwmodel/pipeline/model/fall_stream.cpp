#include "hwmodel/pipeline/model/fall_stream.h"

#include <algorithm>
#include <utility>

namespace voxmelt::hwmodel {

FallStream::FallStream(const state::BitPlane& falling, const Shape& shape) {
  for (int tile = 0; tile < shape.tiles(); ++tile) {
    FallMasks masks;
    masks.reserve(shape.tokens());
    for (Place place = begin_of(shape, tile); place.ordinal < shape.tokens(); place.next(shape)) {
      const int cells = std::min(shape.lanes, shape.grid.x - place.x);
      std::uint32_t mask = 0;
      for (int lane = 0; lane < cells; ++lane)
        if (falling.test(place.x + lane, place.y, place.z)) mask |= std::uint32_t{1} << lane;
      masks.push_back(mask);
    }
    tiles_.push_back(std::move(masks));
  }
}

}  // namespace voxmelt::hwmodel
