#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "hwmodel/explore/sweep.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "kernel/scene/text/compose.h"
#include "kernel/scene/text/reader.h"

namespace voxmelt::hwmodel::explore {
namespace {

constexpr int kClocks = 12;  // equal steps up to the highest clock

}  // namespace

std::vector<int> lanes_worth_trying(int across) {
  std::vector<int> lanes;
  int blocks = 0;
  for (int p = 1; p <= kMostLanes; ++p)
    if (const int count = (across + p - 1) / p; count != blocks) {
      lanes.push_back(p);
      blocks = count;
    }
  return lanes;
}

Axes usual_axes(const Question& question) {
  Axes axes;
  axes.lanes = lanes_worth_trying(question.grid.x);
  const int most_steps = host_sees_each_step(question.parameters) ? 1 : kMostCascade;  // of a pass
  for (int t = 1; t <= most_steps; ++t) axes.cascade.push_back(t);
  axes.substeps = {1};
  if (question.parameters.flow.law == rule::Law::viscous)
    for (int n = 2; n <= std::min(question.substeps, kMostSubsteps); n *= 2) axes.substeps.push_back(n);
  axes.fifo_depth = {1, 2, 4, 8};
  axes.overlap = {0, 1};
  axes.coded = {0};
  if (question.volume != nullptr && question.memory) axes.coded = {0, 1};
  axes.tiles = {1, 2, 4, 8, 16};
  if (question.device.chain > 1) {  // passes wait for their halos
    axes.tiles = {question.device.chain};
    axes.overlap = {0};
  }
  for (int i = 1; i <= kClocks; ++i)
    if (const int mhz = question.device.clock_mhz.value * i / kClocks; mhz > 0) axes.clock_mhz.push_back(mhz);
  return axes;
}

std::vector<int> tiles_of(const Axes& axes, const Question& question, const Configuration& hw) {
  Configuration tried = hw;
  if (axes.tile) {
    tried.tile = *axes.tile;
    const bool possible =
        tried.tile % hw.lanes == 0 && tile_problem(question.parameters, question.grid, tried).empty();
    return possible ? std::vector<int>{tried.tile} : std::vector<int>{};
  }
  std::vector<int> widths;
  for (const int tiles : axes.tiles)
    if (tiles == 1)
      widths.push_back(0);
    else if (const auto width = narrowest_tile(question.parameters, question.grid, hw, tiles))
      widths.push_back(*width);
  return widths;
}

void keep_only(Axes& axes, const std::vector<std::string>& sets) {
  scene::Value document;
  for (const std::string& set : sets) scene::apply_override(document, set);
  scene::Reader root(document, "");
  std::optional<scene::Reader> hw = root.table("hw");
  if (!hw) return;
  for (const Axis& axis : kAxes) {
    const std::string key(axis.key);
    std::vector<int>* values = &(axes.*axis.values);
    if (!hw->has(key)) continue;
    const int value = hw->integer(key, 0, 1'000'000);
    // Any clock up to the highest is allowed, and any number of lanes and steps.
    const int most = values == &axes.clock_mhz ? values->back()
                     : values == &axes.lanes   ? kMostLanes
                     : values == &axes.cascade ? kMostCascade
                                               : 0;
    if (most > 0 ? value < 1 || value > most
                 : std::find(values->begin(), values->end(), value) == values->end()) {
      std::string known;
      for (const int one : *values) known += (known.empty() ? "" : ", ") + std::to_string(one);
      hw->fail(key, " = " + std::to_string(value) + " is not among those that are tried: " + known);
    }
    *values = {value};
  }
  if (hw->has("tile")) axes.tile = hw->integer("tile", 0, kMostTile);
  hw->finish();
}

}  // namespace voxmelt::hwmodel::explore
