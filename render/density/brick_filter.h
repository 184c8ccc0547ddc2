// Filters the channels of some bricks side by side, and mixes the intensities that liquid and solid ask for.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/density/cell_fields.h"
#include "render/density/low_pass.h"

namespace voxmelt::render {

// A byte per brick: the channels that must be filtered in it.
using BrickFlags = std::vector<std::uint8_t>;

// Where in a brick they must be filtered; along x always everywhere.
struct DirtyPart {
  BrickPart matter, heat;
};

// Of all channels but the intensity: the shares reach as far as that does, and at least to the first cell of
// air, even where nothing is filtered.
inline int channel_passes(int liquid_passes, int solid_passes) {
  return std::max({liquid_passes, solid_passes, 1});
}

// Its memory is taken once and used again, for task after task.
class BrickFilter {
 public:
  struct Task {
    const CellFields& cells;
    int liquid_passes, solid_passes;
    const BrickFlags& flags;
    const std::vector<DirtyPart>& parts;
    ChannelValues& to;
  };

  explicit BrickFilter(const state::Grid& grid) : low_pass_(grid) {}

  // The bricks of row (by, bz): in each, those channels whose flag it has.
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
