// The fields of a volume are stored as blocks: slabs of whole slices, packed by all threads.
#pragma once

#include <cstdint>
#include <string_view>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"
#include "kernel/run/checkpoint/blocks.h"

namespace voxmelt::checkpoint {

// Writes every field that the volume has, in the order of their table. Optional fields are written if they
// are there.
void put_volume(BlockWriter& writer, cpu::Workers& workers, const state::Volume& volume);
state::Volume take_volume(BlockReader& reader, state::Grid grid);

void put_field(BlockWriter& writer, cpu::Workers& workers, std::string_view kind,
               const state::Field<std::uint16_t>& field, state::Grid grid);
state::Field<std::uint16_t> take_field(BlockReader& reader, std::string_view kind, state::Grid grid);

}  // namespace voxmelt::checkpoint
