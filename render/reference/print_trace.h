// The trace of one pixel of a state is printed as text (docs/picture/trace.md).
#pragma once

#include <ostream>

#include "kernel/automaton/state/volume.h"
#include "kernel/scene/look.h"
#include "kernel/scene/shape/terrain.h"
#include "render/packet/draw_picture.h"

namespace voxmelt::render {

// Prints the trace of pixel (x, y), counted from the upper left corner. A terrain of another size than the
// volume's counts as none.
void print_trace(std::ostream& out, const state::Volume& volume, const scene::Look& look,
                 const scene::Light& light, const scene::Terrain& terrain, const scene::Camera& camera,
                 Setting setting, int x, int y);

}  // namespace voxmelt::render
