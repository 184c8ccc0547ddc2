// False colours of cells say what the picture of the materials does not show.
#pragma once

#include <functional>
#include <span>
#include <string_view>

#include "kernel/automaton/rule/parameters.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/automaton/step/awake_tiles.h"
#include "render/cells/filled_cells.h"
#include "render/image/image.h"

namespace voxmelt::render {

enum class CellColours { phase, temperature, sleep };

// Gives a name to a colour. Names that are numbers are places of a scale; colours between them are mixed.
struct ColourMark {
  std::string_view name;
  Rgb colour;
};
std::span<const ColourMark> marks_of(CellColours colours);

using ColourOf = std::function<Rgb(const CellIndex&)>;
ColourOf by_phase(const state::Volume& volume);
// The volume has heat. Inert cells without a temperature have a colour of their own.
ColourOf by_temperature(const state::Volume& volume, const rule::Parameters& parameters);
ColourOf by_sleep(step::AwakeTiles awake);

}  // namespace voxmelt::render
