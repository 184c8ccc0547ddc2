// The lag tells how far behind its input a stage gives its cells, and how far along x it looks.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/model/shape.h"
#include "hwmodel/pipeline/model/stage.h"
#include "hwmodel/pipeline/model/stage_kind.h"

namespace voxmelt::hwmodel {

// Counts the planes, columns and single tokens that a stage must have seen before it can give its first cell.
// `reach` tells how far along x the cells lie that it looks at.
struct Lag {
  int planes = 0, columns = 0, singles = 0, reach = 0;
  std::int64_t tokens(const Shape& shape) const {
    return planes * shape.plane() + columns * shape.column() + singles;
  }
};
Lag lag_of(StageKind kind, const Design& design);

// Returns the registers that the circuit of a stage has beyond its lag, in tokens (hwmodel/rtl). It is 0 for
// a stage that is not written in SystemVerilog.
int circuit_registers(StageKind kind, const Design& design);
// Returns the same, and 0 in a design without them.
int registers_of(StageKind kind, const Design& design);
// A vent or a drain has so many of them.
inline constexpr int kOpeningRegisters = 26;
// The temperature of a cell takes so many of them where there are several materials.
inline constexpr int kCurveRegisters = 3;
// Returns how many vents and drains the circuit of stage source has room for.
struct Openings {
  int vents, drains;
};
Openings openings_of(const Design& design);

}  // namespace voxmelt::hwmodel
