// The host's part of the ray caster: what it writes into registers and memory before a picture. It takes the
// data of the software's picture as they are, and lays them out as docs/hardware.md says.
#pragma once

#include "hwmodel/raycast/configuration.h"
#include "hwmodel/raycast/layout.h"
#include "hwmodel/raycast/registers.h"
#include "render/packet/picture_data.h"

namespace voxmelt::hwmodel::raycast {

Registers registers_of(const render::PictureData& data);

}  // namespace voxmelt::hwmodel::raycast
