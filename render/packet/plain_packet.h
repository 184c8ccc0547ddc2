// Packets of one ray follow render/rule in 64 bits. They serve cameras whose numbers do not fit the lanes.
#pragma once

#include "render/packet/picture_data.h"

namespace voxmelt::render {

const Packets& plain_packets();

}  // namespace voxmelt::render
