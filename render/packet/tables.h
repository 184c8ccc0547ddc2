// All pictures share these tables.
#pragma once

#include <cstdint>

#include "render/rule/tone.h"

namespace voxmelt::render {

const picture::Tone& tone_table();
const picture::Bytes& byte_table();
// Returns the table of rule/normal.h. Each entry is the inverse root, plus 65536 times how much less the next
// one is.
const std::uint32_t* inverse_roots();

}  // namespace voxmelt::render
