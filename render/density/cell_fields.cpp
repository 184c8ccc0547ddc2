#include "render/density/cell_fields.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "render/density/slice_writer.h"

namespace voxmelt::render {
namespace {

std::int32_t value_of_all(const state::Grid& grid, const state::Grid& brick,
                          const Values<std::uint16_t>& values) {
  const CellBox box = cells_of(grid, brick);
  const std::uint16_t first = values[grid.index(box.low.x, box.low.y, box.low.z)];
  unsigned different = 0;
  for_rows(grid, box, [&](std::size_t at, const state::Grid&, int cells) {
    for (int x = 0; x < cells; ++x)
      different |= static_cast<unsigned>(values.data()[at + static_cast<std::size_t>(x)] ^ first);
  });
  if (different != 0) return CellFields::kMixed;
  return first;
}

}  // namespace

CellFields::CellFields(const state::Grid& size)
    : ChannelValues(size.cells()), grid(size), bricks(brick_grid(size)) {
  for (auto& of_channel : uniform_) of_channel.assign(bricks.cells(), 0);
  written_.assign(static_cast<std::size_t>(size.z) * static_cast<std::size_t>(size.y), 0);
}

BrickFlags CellFields::update(const state::Volume& volume, int smooth, const scene::Terrain& terrain,
                              cpu::Workers& workers) {
  Columns columns = find_columns(volume, smooth, terrain, workers);
  if (columns.obstacles && obstacle.empty()) obstacle = Values<std::uint16_t>(grid.cells());

  BrickFlags changed(bricks.cells(), 0);
  workers.run(bricks.z, [&](int bz) {
    SliceWriter slice(volume, columns, *this);
    for (int z = bz * kBrickSide; z < std::min((bz + 1) * kBrickSide, grid.z); ++z) slice.write(z, changed);

    const auto values = std::as_const(*this).all();
    for (int by = 0; by < bricks.y; ++by)
      for (int bx = 0; bx < bricks.x; ++bx) {
        const std::size_t brick = bricks.index(bx, by, bz);
        for (std::size_t channel = 0; channel < kChannels; ++channel)
          if ((changed[brick] & flag_of(static_cast<int>(channel))) != 0)
            uniform_[channel][brick] = value_of_all(grid, {bx, by, bz}, *values[channel]);
      }
  });
  if (!columns.obstacles) obstacle = {};
  ground = std::move(columns.ground);
  wetness = std::move(columns.wetness);
  return changed;
}

CellFields cell_fields(const state::Volume& volume, int smooth, const scene::Terrain& terrain) {
  CellFields fields(volume.grid);
  cpu::Workers alone(1);
  fields.update(volume, smooth, terrain, alone);
  return fields;
}

}  // namespace voxmelt::render
