// The circuits know each material by rows of constants (docs/automaton.md, section 6). The first material's
// row is the lowest one. A scene of one material has one row.
#pragma once

#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/materials.h"
#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

// The words of a wide port, the lowest first. There are 2^bits materials.
using PortWords = std::vector<std::uint32_t>;

PortWords curve_rows(const Design& design, int bits);    // 49 bits each, see curve_unit.sv
PortWords melting_rows(const Design& design, int bits);  // 33, see melt_lane.sv
PortWords bed_rows(const Design& design, int bits);      // 48, see bed_unit.sv
PortWords air_rows(const Design& design, int bits);      // 48: the rates of air with one, two and three axes
// 16 bits for each pair of materials. `only` and `row` are as PairWeights has them.
PortWords pair_rows(const Design& design, std::uint16_t only, PairWeights::Row row, int bits);
// Returns the rates of exchange with one, two and three exposed axes, 16 bits each.
std::uint64_t exchange_weights(std::int64_t rate);

}  // namespace voxmelt::hwmodel
