// The window {cell that comes, west, south, south-west} over which both stages of the paper's spread scatter:
// which stretches of its delay are memories of their own, and what each must hold.
#pragma once

#include <vector>

#include "hwmodel/channel/tap_line.h"
#include "hwmodel/stream/shape.h"

namespace voxmelt::hwmodel {

// Bits of a word on its way. Only lane P - 1 waits a column of blocks for its east neighbour, and after its
// north neighbour one more for the north-east one (8 neighbours); the others have them in their own token.
struct WindowBits {
  int last_lane_before_east, plane, last_lane_before_north_east, finished;
};

inline std::vector<BufferCost> window_buffers(const Shape& shape, bool eight, const WindowBits& bits) {
  const std::int64_t column = shape.column(), others = shape.lanes - 1;
  std::vector<BufferCost> buffers{{"east memory", column, 1, bits.last_lane_before_east},
                                  {"east memory, other lanes", column, others, bits.plane},
                                  {"plane memory", shape.plane() - column, shape.lanes, bits.plane}};
  if (eight) {
    buffers.push_back({"north-east memory", column, 1, bits.last_lane_before_north_east});
    buffers.push_back({"alignment memory", column, others, bits.finished});
  }
  std::erase_if(buffers, [](const BufferCost& one) { return one.total() == 0; });
  return buffers;
}

// Tokens from the coming of a cell to that of the last one it exchanges anything with.
inline std::int64_t window_lag(const Shape& shape, bool eight) {
  return shape.plane() + (eight ? shape.column() : 0);
}

}  // namespace voxmelt::hwmodel
