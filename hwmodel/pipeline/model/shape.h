// The stream has z outermost, then blocks of P cells along x, then y (gravity) innermost. One token holds the
// P cells of one block at one height.
//
// A grid that is wider than the memories of the stages goes through in tiles. Each tile is a stream of its
// own, of some neighbouring blocks. Tiles overlap. Beside a cut, the `halo` of a tile is computed for its
// neighbours only. Every block has one tile as its owner.
#pragma once

#include <algorithm>
#include <cstdint>

#include "kernel/automaton/state/grid.h"

namespace voxmelt::hwmodel {

struct Shape {
  state::Grid grid;
  int lanes = 1;
  int tile = 0;  // blocks of a tile; 0: those of the grid
  int halo = 0;  // blocks of a tile that another one owns, beside each cut

  // The following describe one stream, which is a tile.
  int blocks() const { return tile > 0 ? tile : grid_blocks(); }          // blocks along x
  std::int64_t column() const { return grid.y; }                          // tokens of a column of blocks
  std::int64_t plane() const { return std::int64_t{blocks()} * grid.y; }  // tokens from z to z + 1
  std::int64_t tokens() const { return plane() * grid.z; }

  int grid_blocks() const { return (grid.x + lanes - 1) / lanes; }
  bool tiled() const { return blocks() < grid_blocks(); }
  int tiles() const { return tiled() ? (grid_blocks() - 2 * halo + inner() - 1) / inner() : 1; }
  // Return the first block of tile k, and the blocks that it owns. The last tile ends with the grid, and may
  // have a wider halo.
  int first_block(int k) const { return tiled() ? std::min(k * inner(), grid_blocks() - tile) : 0; }
  int owned_begin(int k) const { return k == 0 ? 0 : k * inner() + halo; }
  int owned_end(int k) const { return k + 1 == tiles() ? grid_blocks() : owned_begin(k + 1); }
  int owner(int block) const { return tiled() ? std::clamp((block - halo) / inner(), 0, tiles() - 1) : 0; }
  bool owns(int k, int x) const {
    return x >= owned_begin(k) * lanes && x < std::min(owned_end(k) * lanes, grid.x);
  }

 private:
  int inner() const { return tile - 2 * halo; }  // blocks of a tile between two cuts that it owns
};

// Tells where a token of the stream lies. `x` is that of its lane 0, in the grid.
struct Place {
  int x = 0, y = 0, z = 0;
  std::int64_t ordinal = 0;  // in the stream of its tile
  int left = 0;              // the lowest x of the tile

  // Returns true if there is a block before it in the tile. If not, the token stands beside the border or a
  // cut.
  bool has_west() const { return x > left; }

  void next(const Shape& shape) {
    ++ordinal;
    if (++y < shape.grid.y) return;
    y = 0;
    x += shape.lanes;
    if (x < left + shape.blocks() * shape.lanes) return;
    x = left;
    ++z;
  }
};

inline Place begin_of(const Shape& shape, int tile) {
  const int left = shape.first_block(tile) * shape.lanes;
  return {left, 0, 0, 0, left};
}

inline Place place_of(const Shape& shape, std::int64_t ordinal, int tile = 0) {
  const std::int64_t column = ordinal / shape.grid.y;
  const int left = shape.first_block(tile) * shape.lanes;
  return {left + static_cast<int>(column % shape.blocks()) * shape.lanes,
          static_cast<int>(ordinal % shape.grid.y), static_cast<int>(column / shape.blocks()), ordinal, left};
}

// Returns the number of the token with which a cell leaves for good, in a pass that streams all tiles.
inline std::int64_t owned_ordinal(const Shape& shape, int x, int y, int z) {
  const int block = x / shape.lanes, tile = shape.owner(block);
  return tile * shape.tokens() +
         (z * std::int64_t{shape.blocks()} + block - shape.first_block(tile)) * shape.grid.y + y;
}

// Returns the position of a cell in the stream of a grid that is one tile. The cell with the smaller position
// leaves a stage first.
inline std::int64_t stream_order(const Shape& shape, int x, int y, std::int64_t z) {
  return ((z * shape.blocks() + x / shape.lanes) * shape.grid.y + y) * shape.lanes + x % shape.lanes;
}

}  // namespace voxmelt::hwmodel
