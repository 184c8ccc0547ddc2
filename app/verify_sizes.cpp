#include "app/verify_sizes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/interrupt.h"
#include "app/print.h"
#include "hwmodel/explore/held.h"
#include "hwmodel/explore/size_fifos.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace explore = hwmodel::explore;

void print_table(const explore::Sizing& sizing, const hwmodel::Configuration& c) {
  print("{:<36} {:>6} {:>8} {:>10} {:>20}\n", "channel", "depth", "highest", "bits", "one less costs");
  std::int64_t bits = 0;
  for (const explore::SizedChannel& channel : sizing.channels) {
    const std::int64_t own = std::int64_t{channel.depth} * channel.bits * c.lanes;
    bits += own;
    print("{:<36} {:>6} {:>8} {:>10} {:>20}\n", channel.name, channel.depth, channel.highest, own,
          channel.depth == 1              ? "-"
          : channel.one_less == INT64_MAX ? "it hangs"
                                          : fmt::format("{} cycles", channel.one_less));
  }
  const std::int64_t saved = sizing.deep_cycles - sizing.cycles;
  print("{} bits in {} channels; {} cycles, {} depth {}; {} runs simulated\n", bits, sizing.channels.size(),
        sizing.cycles, saved == 0 ? "as with" : fmt::format("{} fewer than with", saved), hwmodel::kMostDepth,
        sizing.runs);
}

}  // namespace

void check_channels(const VerifiedStream& stream, const hwmodel::Preset& preset) {
  const hwmodel::Configuration& c = preset.configuration;
  const std::vector<std::string> names =
      explore::channel_names({stream.parameters, {stream.volume.grid, c.lanes}, c.substeps}, c);
  for (const hwmodel::ChannelDepth& one : c.depths)
    if (std::find(names.begin(), names.end(), one.name) == names.end())
      throw UsageError(
          fmt::format("error: hw.channel: this machine has no channel \"{}\"; it has \"{}\" and {} others",
                      one.name, names.front(), names.size() - 1));
}

std::int64_t size_channels(const VerifiedStream& stream, const Common& common, const std::string& file,
                           hwmodel::Preset& preset) {
  hwmodel::Configuration& c = preset.configuration;
  const state::Grid grid = stream.volume.grid;
  explore::TimedRun run{
      stream.parameters, grid, c, stream.first_step, stream.steps, stop_if_interrupted, {}, {}, {}, {}};
  std::optional<explore::SizingMemory> memory;
  std::optional<explore::Held> held;
  if (preset.caster.dram) memory = {*preset.caster.dram, preset.caster.clock_mhz};
  if (memory || hwmodel::host_sees_each_step(stream.parameters)) {
    held.emplace(run, hwmodel::design_of(stream.parameters, grid, c), stream.volume,
                 find_phased_implementation(common), stop_if_interrupted);
    held->give_to(run);
  }
  const explore::Sizing sizing = explore::size_fifos(run, memory);
  c.depths.clear();
  c.fifo_depth = hwmodel::Configuration{}.fifo_depth;  // as --hw reads the file
  for (const explore::SizedChannel& channel : sizing.channels)
    c.depths.push_back({channel.name, channel.depth});
  if (!common.quiet) print_table(sizing, c);
  const std::string title =
      fmt::format("{} lanes, {} steps, channels as deep as they need", c.lanes, c.cascade);
  io::write_file(file, explore::toml_of(sizing, c, title));
  if (!common.quiet) print("depths  {}\n", file);
  return sizing.cycles;
}

bool check_sized(std::int64_t wanted, std::int64_t cycles) {
  if (cycles == wanted) return true;
  print("the sized machine took {} cycles, and {} when its channels were sized\n", cycles, wanted);
  return false;
}

}  // namespace voxmelt::app
