// The writer computes what the cells of one brick contribute, and takes over what differs from the kept
// values.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "render/density/cell_fields.h"
#include "render/density/columns.h"
#include "render/density/loops.h"

namespace voxmelt::render {

class BrickWriter {
 public:
  BrickWriter(const state::Volume& volume, CellFields& fields, const Loops& with)
      : volume_(volume), fields_(fields), loops_(with) {}

  // Writes the solid, liquid and heat (or tone) of a brick.
  void write_matter(const state::Grid& brick);
  // Takes over the inert cells of the word of 64 cells along x that holds the brick, on all of its rows.
  // Returns the places along x at which one has changed.
  std::uint64_t take_inert(const state::Grid& brick);
  // Writes obstacles and intensity afterwards, once the columns of the brick are known.
  void write_intensity(const state::Grid& brick);

 private:
  static constexpr std::size_t kCells = kBrickSide * kBrickSide * kBrickSide;
  using Cells = std::array<std::uint16_t, kCells>;

  std::uint16_t& at(Cells& cells, int x, int y, int z) const {
    return cells[((z - box_.low.z) * kBrickSide + y - box_.low.y) * kBrickSide + x - box_.low.x];
  }
  unsigned inert_bits(int y, int z) const;
  bool put_obstacles(const state::Grid& brick);
  void put_matter();
  void put_plan(const Plan& plan, int x, int z);
  void fill_ground(const Plan& plan, int x, int z);
  void move_puddle(const Plan& plan, int x, int z);
  void take_over(int channel, Cells& fresh, std::size_t brick);

  const state::Volume& volume_;
  CellFields& fields_;
  const Loops& loops_;
  CellBox box_{};
  Cells intensity_{}, obstacle_{};
};

}  // namespace voxmelt::render
