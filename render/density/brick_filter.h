// The filter works on the channels of some bricks side by side. It mixes the intensities that liquid and
// solid ask for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/density/cell_fields.h"
#include "render/density/loops.h"
#include "render/density/low_pass.h"

namespace voxmelt::render {

// Holds a byte per brick, with the channels that must be filtered in it.
using BrickFlags = std::vector<std::uint8_t>;

// Tells where in a brick they must be filtered. Along x that is everywhere.
struct DirtyPart {
  BrickPart matter, heat;
};

// Returns the passes of all channels but the intensity. The shares reach as far as the intensity, and at
// least to the first cell of air, even if nothing is filtered.
inline int channel_passes(int liquid_passes, int solid_passes) {
  return std::max({liquid_passes, solid_passes, 1});
}

// Filters rows of bricks. Its memory is taken once and used again, for task after task.
class BrickFilter {
 public:
  struct Task {
    const CellFields& cells;
    int liquid_passes, solid_passes;
    const BrickFlags& flags;
    const std::vector<DirtyPart>& parts;
    ChannelValues& to;
    const Loops& with;
  };

  explicit BrickFilter(const state::Grid& grid) : low_pass_(grid) {}

  // Filters the bricks of row (by, bz). In each it filters the channels whose flag is set.
  void filter_row(const Task& task, int by, int bz);

 private:
  void filter(const Task& task, int channel, const CellBox& box);
  void mix_intensity(const Task& task, const CellBox& box);

  LowPass low_pass_;
  static constexpr std::size_t kMostCells = kMostBricks * kBrickSide * kBrickSide * kBrickSide;
  std::unique_ptr<std::uint16_t[]> weights_ = std::make_unique_for_overwrite<std::uint16_t[]>(kMostCells);
  std::unique_ptr<std::uint16_t[]> other_ = std::make_unique_for_overwrite<std::uint16_t[]>(kMostCells);
};

}  // namespace voxmelt::render
