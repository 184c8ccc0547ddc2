#include <cstdint>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/cell_wires.h"
#include "hwmodel/pipeline/model/pipeline.h"

namespace voxmelt::hwmodel {
namespace {

// Describes the cells of a token, by the table of their wires.
TokenType cell_tokens(int lanes) {
  TokenType type{lanes, {}, {}};
  for (const CellWire& row : kCellWires)
    type.wires.push_back({std::string(row.name), row.bits, row.has_sign});
  type.read = [lanes](const void* token, std::int64_t* values) {
    const Cell* cells = static_cast<const Cell*>(token);
    for (int lane = 0; lane < lanes; ++lane)
      for (const CellWire& row : kCellWires) *values++ = row.get(cells[lane]);
  };
  return type;
}

}  // namespace

std::vector<TokenChannel> Pipeline::token_channels() const {
  std::vector<TokenChannel> all;
  for (const ChannelReport& channel : channels())
    if (!is_feed(channel.producer))
      all.push_back(
          {channel.name, static_cast<int>(all.size()), channel.depth, cell_tokens(design().shape.lanes)});
  return all;
}

std::vector<StageClasses> Pipeline::stage_classes() const {
  std::vector<StageClasses> all;
  for (const StageReport& stage : stages())
    all.push_back({"step " + std::to_string(stage.cascade) + ": " + std::string(name_of(stage.kind)),
                   {kCycleClasses.begin(), kCycleClasses.end()}});
  return all;
}

std::vector<std::int64_t> Pipeline::stage_counts() const {
  std::vector<std::int64_t> counts;
  for (const StageCycles& account : accounts())
    for (const auto part : StageCycles::kParts) counts.push_back(account.*part);
  return counts;
}

}  // namespace voxmelt::hwmodel
