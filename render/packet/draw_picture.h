// The picture by packets of rays (docs/picture.md).
#pragma once

#include "kernel/engine/cpu/instruction_set.h"
#include "render/image/image.h"
#include "render/packet/picture_data.h"
#include "render/rule/antialias.h"

namespace voxmelt::render {

// The packets of an instruction set, and the best that this processor can run.
const Packets& packets_of(cpu::InstructionSet set);
const Packets& best_packets();

// One sample a pixel; four where a pixel differs from a neighbour; sixteen where it still does.
enum class Setting { fast, normal, best };

Image draw_picture(const PictureData& data, Setting setting, const Packets& packets, int threads);

}  // namespace voxmelt::render
