// Both stages of the paper's spread scatter over the window {cell that comes, west, south, south-west}. A
// cell exchanges with its southern neighbours when it comes, and with those of its own row only when it
// leaves the plane memory. Earlier results would have to be kept, and a partial sum is as wide as a cell.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/fabric/tap_line.h"
#include "hwmodel/pipeline/model/shape.h"

namespace voxmelt::hwmodel {

// Counts the bits of a word on its way. Only lane P - 1 waits for its eastern neighbours, for a column of
// blocks. After it came, it waits for the south-eastern one. After it left the plane memory, it waits for the
// eastern and north-eastern ones.
struct WindowBits {
  int before_south_east, plane, before_east, finished;
};

inline std::vector<BufferCost> window_buffers(const Shape& shape, const WindowBits& bits) {
  const std::int64_t column = shape.column(), others = shape.lanes - 1;
  std::vector<BufferCost> buffers{{"south-east memory", column, 1, bits.before_south_east},
                                  {"south-east memory, other lanes", column, others, bits.plane},
                                  {"plane memory", shape.plane() - column, shape.lanes, bits.plane},
                                  {"east memory", column, 1, bits.before_east},
                                  {"alignment memory", column, others, bits.finished}};
  std::erase_if(buffers, [](const BufferCost& one) { return one.total() == 0; });
  return buffers;
}

// Counts the tokens from the coming of a cell to that of the last one it exchanges anything with.
inline std::int64_t window_lag(const Shape& shape) { return shape.plane() + shape.column(); }

}  // namespace voxmelt::hwmodel
