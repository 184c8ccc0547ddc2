// The changes that a scene makes of itself, [[change]], are lines like those of a journal.
#pragma once

#include <vector>

#include "kernel/scene/scene.h"
#include "library/journal/journal.h"

namespace voxmelt::journal {

// Throws InputError with file:line:column.
std::vector<Line> timeline_of(const scene::Scene& scene);

}  // namespace voxmelt::journal
