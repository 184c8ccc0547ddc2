#include "hwmodel/pipeline/check/side_bands.h"

#include <optional>

namespace voxmelt::hwmodel {

ShownRuns::ShownRuns(const scalar::Reference& reference, state::Grid grid) : grid_(grid) {
  const state::Layout layout(grid);
  begins_.reserve(column(0, grid.z) + 1);
  for (int z = 0; z < grid.z; ++z)
    for (int x = 0; x < grid.x; ++x) {
      begins_.push_back(runs_.size());
      bool inside = false;
      for (int y = 0; y < grid.y; ++y) {
        // A blocked cell lies between two runs of a column.
        const state::Slot at = layout.at(x, y, z);
        const std::optional<rule::Column> shows = reference.run_of(at);
        if (shows && inside)
          runs_.back().last = y;
        else if (shows)
          runs_.push_back({y, y, shows->head, shows->mobility, shows->exposed, shows->dead, shows->limit,
                           reference.in_shut_run(at)});
        inside = shows.has_value();
      }
    }
  begins_.push_back(runs_.size());
}

const ShownRuns::Run* ShownRuns::at(int x, int y, int z) const {
  const std::size_t here = column(x, z);
  for (std::size_t run = begins_[here]; run < begins_[here + 1]; ++run)
    if (runs_[run].first <= y && y <= runs_[run].last) return &runs_[run];
  return nullptr;
}

Surroundings::Surroundings(const state::Volume& volume) : around_(volume.grid) {
  const state::Grid& grid = volume.grid;
  const auto blocked = [&](int x, int y, int z) {
    return !grid.contains(x, y, z) || volume.solid.test(x, y, z) || volume.inert.test(x, y, z);
  };
  const auto air = [&](int x, int y, int z) { return !blocked(x, y, z) && !volume.liquid.test(x, y, z); };
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y)
      for (int x = 0; x < grid.x; ++x) {
        int around = 0;
        if (volume.solid.test(x, y, z) || volume.liquid.test(x, y, z)) {
          around += air(x - 1, y, z) || air(x + 1, y, z);
          around += air(x, y - 1, z) || air(x, y + 1, z);
          around += air(x, y, z - 1) || air(x, y, z + 1);
        }
        if (blocked(x - 1, y, z) || blocked(x + 1, y, z) || blocked(x, y, z - 1) || blocked(x, y, z + 1))
          around |= 4 | 8;
        if (blocked(x, y - 1, z) || blocked(x, y + 1, z)) around |= 8;
        around_[volume.at(x, y, z)] = static_cast<std::uint8_t>(around);
      }
}

}  // namespace voxmelt::hwmodel
