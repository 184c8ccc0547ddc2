// Filters the channels of some bricks side by side, and mixes the intensities that liquid and solid ask for.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "render/density/cell_fields.h"
#include "render/density/low_pass.h"

namespace voxmelt::render {

// A byte per brick: the channels that must be filtered in it.
using BrickFlags = std::vector<std::uint8_t>;

class BrickFilter {
 public:
  BrickFilter(const CellFields& cells, int liquid_passes, int solid_passes, ChannelValues& to)
      : cells_(cells),
        liquid_passes_(liquid_passes),
        solid_passes_(solid_passes),
        to_(to),
        low_pass_(cells.grid) {}

  // The bricks of row (by, bz): in each, those channels whose flag it has.
  void filter_row(int by, int bz, const BrickFlags& flags);

 private:
  void fill(int channel, const state::Grid& brick);
  void filter(int channel, const state::Grid& first, int bricks);
  void mix_intensity(const state::Grid& first, int bricks);
  bool has_one_value(int channel, const state::Grid& brick) const;

  const CellFields& cells_;
  int liquid_passes_, solid_passes_;
  ChannelValues& to_;
  LowPass low_pass_;
  static constexpr std::size_t kMostCells = kMostBricks * kBrickSide * kBrickSide * kBrickSide;
  std::unique_ptr<std::uint16_t[]> weights_ = std::make_unique_for_overwrite<std::uint16_t[]>(kMostCells);
  std::unique_ptr<std::uint16_t[]> other_ = std::make_unique_for_overwrite<std::uint16_t[]>(kMostCells);
};

}  // namespace voxmelt::render
