// A device offers numbers of parts. Its family tells the shapes of these parts, and what a stage costs. The
// numbers come from the files in devices/ and families/, which name the source of each.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "hwmodel/explore/ranged.h"
#include "hwmodel/pipeline/model/stage_kind.h"

namespace voxmelt::hwmodel::explore {

enum Resource : std::uint8_t { kLut, kFf, kDsp, kBram, kUram, kResources };
inline constexpr std::array<Resource, kResources> kEachResource{kLut, kFf, kDsp, kBram, kUram};
inline constexpr std::array<std::string_view, kResources> kResourceNames{"lut", "ff", "dsp", "bram", "uram"};
using Amounts = std::array<std::int64_t, kResources>;

struct Widths {
  int wide = 0, narrow = 0;
};
struct MemoryShape {
  int bits = 0, words = 0;
  int luts = 0;  // that it takes, if it is made of them
};
// Counts logic beside memories and products: for a lane of a stage, for a unit, or for a channel.
struct LogicCost {
  Ranged<std::int64_t> lut, ff;
};
struct StageCost {
  LogicCost lane;
  std::vector<Widths> multipliers;  // the last one stands for all further ones
  int products = 0, dsps = 0;  // of a lane, so many products were synthesised to so many DSPs; 0: none were
};

struct Family {
  std::string name, title;
  int bram_parts = 1;     // parts of a block of BRAM; the shapes are those of one part
  int byte_bits = 1;      // so many bits of a part are written together, or fewer where it is narrower
  int part_mux_bits = 1;  // a part weighs as much as a choice between two words of so many bits
  std::vector<MemoryShape> bram, uram, lutram;
  int mux_ways = 2, deepest_lutram = 1;
  int register_words = 1;
  Widths product;     // signed factors of a DSP
  LogicCost control;  // what a stage has but once, whatever its lanes
  LogicCost divider, random_block, channel, port, coder, base;
  int port_bits = 0, port_words = 0;  // the buffer of a port to the memory
  std::map<StageKind, StageCost> stages;
};

struct Device {
  std::string name, title;
  Family family;
  Amounts amounts{};
  Amounts shell{};               // what the vendor's platform takes of them
  std::string shell_source;      // empty: there is none
  std::int64_t lutram = 0;       // LUTs that can be memory
  Ranged<int> clock_mhz;         // highest clock
  Ranged<double> fill{1, 1, 1};  // share of LUTs and flip-flops that can be used
  int chain = 1;                 // so many of them, each with a tile of the grid and a memory of its own
  int link_gbit = 100;           // Gbit/s between two neighbours, in each direction
  int link_ns = 1000;            // from the end of one to the end of the other
  Amounts usable() const;        // the shell takes its part first, and only `fill` of the rest can be filled
};

struct NamedText {
  std::string name, text;
};
const std::vector<NamedText>& device_files();
const std::vector<NamedText>& family_files();

// Loads a device by the name of one of these files, or by a path that ends in ".toml". `overrides` are such
// as "device.bram=300" and "family.stage.melt.lut=70". A number that they give has no range, unless they give
// that, too. Throws scene::InputError. If there is no such device, its message begins with "--device NAME".
Device load_device(const std::string& name, const std::vector<std::string>& overrides);

}  // namespace voxmelt::hwmodel::explore
