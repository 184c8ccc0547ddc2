#include "library/version_numbers.h"

#include <cstddef>

#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/automaton/state/grid.h"

namespace voxmelt::library {

static_assert(kBrickSide == state::kBrickSide);

Changes VersionNumbers::changes(const state::Volume& volume, std::uint64_t since) {
  using state::ChangedBricks;
  const ChangedBricks::Seen now = volume.changed.now();
  if (now.volume != volume_ || now.volume == 0) {
    volume_ = now.volume;
    base_ = newest_ + 1;
  }
  newest_ = base_ + now.version;

  Changes changes{newest_, now.volume == 0 || since <= base_ || since > newest_, {}};
  const ChangedBricks::Seen seen{now.volume, changes.everything ? 0 : since - base_};
  const state::Grid bricks = state::brick_grid(volume.grid);
  std::size_t brick = 0;
  for (int z = 0; z < bricks.z; ++z)
    for (int y = 0; y < bricks.y; ++y)
      for (int x = 0; x < bricks.x; ++x, ++brick) {
        if (!changes.everything && !volume.changed.since(ChangedBricks::kHeat, seen, brick)) continue;
        changes.bricks.push_back(
            {x * kBrickSide, y * kBrickSide, z * kBrickSide,
             changes.everything || volume.changed.since(ChangedBricks::kMatter, seen, brick)});
      }
  return changes;
}

}  // namespace voxmelt::library
