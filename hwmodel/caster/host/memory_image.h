// The host lays out what it sends to the ray caster's memory: room for every volume, and the bytes of their
// lines (docs/hardware/pipeline.md).
#pragma once

#include <cstdint>
#include <functional>

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/layout.h"
#include "kernel/automaton/state/grid.h"
#include "render/packet/picture_data.h"

namespace voxmelt::hwmodel::raycast {

// Counts the bricks of the lattice along each axis.
state::Grid lattice_bricks(const render::FieldData& field);

// Counts the stored bricks, the brick of air included.
std::int64_t stored_bricks(const render::FieldData& field);
// Returns layouts and zeroed bytes, with room for so many stored `bricks`.
Memory room_for(const render::PictureData& data, const Configuration& configuration, std::int64_t bricks);

// Takes the bytes of a line, `line_bytes` of them.
using LineSink = std::function<void(std::int64_t line, const std::uint8_t* bytes)>;
// These give the lines of a stored brick of the lattice.
void level_lines(const render::PictureData& data, const Layout& layout, const state::Grid& brick,
                 const LineSink& sink);
void matter_lines(const render::PictureData& data, const Layout& layout, const state::Grid& brick,
                  const LineSink& sink);
// These give all lines of a volume.
void light_lines(const render::PictureData& data, const Layout& layout, const LineSink& sink);
void height_lines(const render::PictureData& data, const Layout& layout, const LineSink& sink);
void texel_lines(const render::PictureData& data, const Layout& layout, const LineSink& sink);

}  // namespace voxmelt::hwmodel::raycast
