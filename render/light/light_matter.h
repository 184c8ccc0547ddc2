// What stops and what sends light, from the field and the ground (docs/picture-light.md, section 4).
#pragma once

#include <cstdint>
#include <vector>

#include "render/density/density_field.h"
#include "render/light/light_volume.h"
#include "render/rule/look.h"

namespace voxmelt::render {

// `ground`: height of each column in 1/4096 cells, [z][x]; empty where there is none.
LightMatter light_matter(const DensityField& field, const std::vector<std::int32_t>& ground,
                         const picture::Look& look);

}  // namespace voxmelt::render
