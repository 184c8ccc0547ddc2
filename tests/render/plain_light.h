// Computes the light by plain loops over render/rule (docs/picture/light.md, sections 4 and 5). The fast
// sweeps must agree with them.
#pragma once

#include <cstdint>
#include <vector>

#include "render/density/density_field.h"
#include "render/light/light_bytes.h"
#include "render/rule/look.h"

namespace voxmelt::test {

// `ground` is the height of each column in 1/4096 cells, [z][x]. It is empty if there is no ground.
render::LightMatter plain_light_matter(const render::DensityField& field,
                                       const std::vector<std::int32_t>& ground, const picture::Look& look);

// `to_light` has the length 2^14.
std::vector<render::LightBytes> plain_light(const render::LightMatter& matter, picture::Vector to_light);

}  // namespace voxmelt::test
