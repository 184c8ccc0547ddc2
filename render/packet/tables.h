// Tables that all pictures share.
#pragma once

#include <cstdint>

#include "render/rule/tone.h"

namespace voxmelt::render {

const picture::Tone& tone_table();
const picture::Bytes& byte_table();
// Of normal.h: the inverse root, and 65536 times how much the next one is less.
const std::uint32_t* inverse_roots();

}  // namespace voxmelt::render
