// Solids of several colours are told apart in the field by a tone (docs/picture/light.md, section 1). It is
// the place of a colour on a line. The first material's colour is in the middle of that line, because it is
// the one that most others touch.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/scene/look.h"

namespace voxmelt::render {

using Tones = std::array<std::uint8_t, rule::kMostMaterials>;  // by material
using Tint = std::array<std::int32_t, 3>;                      // linear light, 4096 is 1

// Returns the different colours of solids, in the order of their tones. There are none if the picture shows
// one colour.
std::vector<Tint> tints_of(const scene::Look& look);

// Returns the tone of each material. There are none if the picture shows one colour.
std::optional<Tones> tones_of(const scene::Look& look);

}  // namespace voxmelt::render
