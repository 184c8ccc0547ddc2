// The light of hot liquid.
#pragma once

#include "kernel/scene/look.h"
#include "render/image/vector.h"

namespace voxmelt::render {

// 0 at look.glow_cold and below, 1 at look.glow_hot and above. Temperature 0..1.
float glow_heat(float temperature, const scene::Look& look);

// Emitted light of a heat 0..1, like a black body that is warmed up: none, dark red, red, orange, yellow.
// Powers without kinks, so that no line shows where one colour becomes the next.
Vec glow_color(float heat);

// Reflecting colour of the crust.
Vec crust_color(float heat);

// Colour of the light that glowing liquid throws on its surroundings.
inline constexpr Vec kGlowLight{1.0f, 0.32f, 0.06f};

}  // namespace voxmelt::render
