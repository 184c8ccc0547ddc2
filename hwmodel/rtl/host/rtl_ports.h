// The ports of a stage in SystemVerilog hold the numbers of the scene while it runs, and the lengths of the
// stage's memories.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hwmodel/pipeline/model/stage.h"

namespace voxmelt::hwmodel {

struct RtlPort {
  std::string_view name;
  int bits;
  std::uint64_t value;
};
struct RtlPorts {
  std::vector<RtlPort> values;
  std::vector<std::pair<std::string_view, std::vector<std::uint32_t>>> wide;
  std::vector<std::uint16_t> table;  // written once, word by word
  std::string refusal;               // why the stage cannot be of this scene; empty: it can
};

// Says what the stages are compiled for: openings, and the longest delays of their memories.
struct RtlSizes {
  std::size_t vents, drains;
  std::int64_t north, column;
  int material_bits;  // of the number of a material; 0: there is one
};
inline constexpr RtlSizes kCompiled{2, 2, 32769, 4097, 4};  // by Verilator, see hwmodel/rtl/*_stage.sv
inline constexpr std::int64_t kAny = std::int64_t{1} << 24;

// Returns how many bits a cell's energy takes in the memories of a scene. A solid has its material there.
int energy_bits(const Design& design, const RtlSizes& sizes);
RtlPorts rtl_ports(StageKind kind, const Design& design, const RtlSizes& sizes = kCompiled);
// Returns the sizes that suit a scene.
RtlSizes sizes_of(const Design& design);
// Tells if a port is the length of a memory. The stage has a parameter for it, too.
bool is_memory(std::string_view port);

}  // namespace voxmelt::hwmodel
