// Before a picture, the host writes into registers and memory of the ray caster. It takes the data of the
// software's picture as they are, and lays them out as docs/hardware/pipeline.md says.
#pragma once

#include "hwmodel/caster/model/configuration.h"
#include "hwmodel/caster/model/layout.h"
#include "hwmodel/caster/model/registers.h"
#include "render/packet/picture_data.h"

namespace voxmelt::hwmodel::raycast {

Registers registers_of(const render::PictureData& data);

}  // namespace voxmelt::hwmodel::raycast
