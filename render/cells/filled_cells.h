// Tells which cells hold matter, and which bricks of 8 x 8 x 8 cells hold any.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"

namespace voxmelt::render {

using CellIndex = std::array<int, 3>;

class FilledCells {
 public:
  static constexpr int kBrick = 8;

  FilledCells(const state::Volume& volume, cpu::Workers& workers);

  bool cell(const CellIndex& c) const {
    return (words_[row(c[1], c[2]) + word(c[0])] >> (c[0] & 63) & 1) != 0;
  }
  bool brick_of(const CellIndex& c) const {
    return bricks_[brick(c[0] / kBrick, c[1] / kBrick, c[2] / kBrick)] != 0;
  }
  const state::Grid& grid() const { return grid_; }

 private:
  static std::size_t word(int x) { return static_cast<std::size_t>(x) / 64; }
  std::size_t row(std::size_t y, std::size_t z) const { return (z * grid_.y + y) * row_words_; }
  std::size_t brick(std::size_t x, std::size_t y, std::size_t z) const {
    return (z * bricks_y_ + y) * bricks_x_ + x;
  }
  void fill_layer(const state::Volume& volume, int layer);

  state::Grid grid_;
  std::size_t row_words_, bricks_x_, bricks_y_;
  std::vector<std::uint64_t> words_;  // solid, liquid or inert
  std::vector<std::uint8_t> bricks_;
};

}  // namespace voxmelt::render
