// Computes one slice of cell fields anew beside the old one, and copies what differs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "render/density/cell_fields.h"
#include "render/density/columns.h"

namespace voxmelt::render {

class SliceWriter {
 public:
  SliceWriter(const state::Volume& volume, const Columns& columns, CellFields& fields);

  // Slice z of the fields becomes the volume's; flags what changed in its bricks.
  void write(int z, BrickFlags& changed);

 private:
  // A row of a channel in the slice at hand. It will be compared with what is kept.
  std::uint16_t* row(int channel, int y);
  std::uint16_t& intensity(int x, int y) { return row(kIntensity, y)[x]; }

  void write_matter(int y);
  void write_obstacles(int x);
  void fill_ground(int x);
  void shift_liquid(int x, int bed, std::int32_t rise);
  void take_over(int y, BrickFlags& changed);

  const state::Volume& volume_;
  const Columns& columns_;
  CellFields& fields_;
  int z_ = 0;
  std::size_t stride_;                    // cells of a row: whole groups of eight
  std::vector<std::uint16_t> values_;     // [channel][y][x]
  std::vector<std::uint8_t> row_in_use_;  // [y]: a flag for each channel
};

}  // namespace voxmelt::render
