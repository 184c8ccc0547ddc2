// Draws cells as boxes of one colour. A face is darker the less it looks up, so that shapes can be seen.
// Faces on the cut plane have the colour itself.
#pragma once

#include "kernel/engine/cpu/workers.h"
#include "render/cells/cell_caster.h"
#include "render/cells/cell_colours.h"
#include "render/image/image.h"

namespace voxmelt::render {

inline constexpr Rgb kBehindCells{232, 236, 240};  // where there is no cell

// The view was made for a picture of this size. A pixel is the mean of samples x samples rays.
Image draw_cells(const CellCaster& caster, int width, int height, int samples, const ColourOf& colour_of,
                 cpu::Workers& workers);

}  // namespace voxmelt::render
