// A wanted cell is the word that a cell must be behind a stage. The checker reads volumes with this code of
// its own. The reader's code would carry its errors into what is expected.
#pragma once

#include <cstdint>

#include "hwmodel/pipeline/check/expectation.h"
#include "hwmodel/pipeline/model/cell.h"

namespace voxmelt::hwmodel {

Cell wanted_cell(const Expected& expected, int x, int y, int z);
Cell wanted_cell(const state::Volume& volume, int x, int y, int z);  // without side bands

// Returns true if all fields of two volumes of one size are equal, in the cells from x on.
bool same_cells(const state::Volume& a, const state::Volume& b, int x, int cells, int y, int z);

// Returns the mobility of a run, as far as the stages that read it can tell. They use it below one of two
// limits.
std::int64_t usable_mobility(const Cell& cell);

}  // namespace voxmelt::hwmodel
