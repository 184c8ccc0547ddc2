// Parts of a mesh that are thinner than the samples of a cell leave no cell behind.
#pragma once

#include "kernel/scene/shape/mesh.h"

namespace voxmelt::scene {

// Looks at places of the edges, at most half a cell apart. The inside of a face is not looked at, because a
// polygon need not be convex, nor plane.
EdgeLength length_of_edges(const Mesh& mesh, const Coverage& coverage);

}  // namespace voxmelt::scene
