// `voxmelt explore` tries all axes, without what --set and --rtl leave out.
#include <fmt/format.h>

#include <set>
#include <string>
#include <vector>

#include "app/explore_command.h"
#include "app/message.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/rtl/write/pipeline_text.h"

namespace voxmelt::app {
namespace {

namespace explore = hwmodel::explore;

// Keeps what `voxmelt rtl` writes. Lanes, steps and sub-steps have rules of their own there, so each value is
// kept that occurs in any pipeline.
void keep_written(explore::Axes& axes, const explore::Question& question) {
  std::string why = "it writes no tiles";
  std::set<int> lanes, cascade, substeps;
  hwmodel::Configuration hw;
  for (const int lane : axes.tile.value_or(0) == 0 ? axes.lanes : std::vector<int>{})
    for (const int steps : axes.cascade)
      for (const int sub : axes.substeps) {
        hw.lanes = lane;
        hw.cascade = steps;
        hw.substeps = sub;
        const std::string reason = unwritten(design_of(question.parameters, question.grid, hw), hw);
        if (!reason.empty()) {
          why = reason;
          continue;
        }
        lanes.insert(lane);
        cascade.insert(steps);
        substeps.insert(sub);
      }
  if (lanes.empty())
    throw UsageError(fmt::format("error: --rtl: `voxmelt rtl` writes no such pipeline: {}", why));
  axes.lanes.assign(lanes.begin(), lanes.end());
  axes.cascade.assign(cascade.begin(), cascade.end());
  axes.substeps.assign(substeps.begin(), substeps.end());
}

}  // namespace

explore::Axes asked_axes(explore::Axes axes, const explore::Question& question,
                         const ExploreCommand& command) {
  if (command.rtl && question.device.chain > 1)
    throw UsageError("error: --rtl: a chain of devices has tiles, which `voxmelt rtl` does not write");
  if (command.rtl) {
    axes.lanes = {1, 2, 4, 8, 16};
    axes.tiles = {1};
  }
  keep_only(axes, command.hw_sets);
  if (command.rtl) keep_written(axes, question);
  return axes;
}

}  // namespace voxmelt::app
