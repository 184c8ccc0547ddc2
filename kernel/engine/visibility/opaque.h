// Solid and inert cells are opaque: they stop rays. A caster reads them here. They are kept from one casting
// to the next, as rows of bits and as bricks of 8x8x8 bits, so that changes are known. They take 3/8 byte for
// each cell of the grid, and changes take 1/8, in pages that stay untaken if nothing stands there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/automaton/state/bit_plane.h"
#include "kernel/automaton/state/changed_bricks.h"
#include "kernel/automaton/state/grid.h"
#include "kernel/automaton/state/pages.h"
#include "kernel/automaton/state/volume.h"
#include "kernel/engine/cpu/workers.h"

namespace voxmelt::visibility {

using Cell = std::array<int, 3>;

class Opaque {
 public:
  struct Box {  // holds all cells from low to high
    Cell low{}, high{};
  };
  struct News {
    bool appeared = false;  // a cell is opaque that was not, or the grid is another one
    Box box;                // of what appeared
    bool vanished = false;  // a cell is no longer opaque
    bool turned = false;    // a cell is solid that was inert, or the reverse
    int emptied = 0;        // number of bricks that held something, and hold nothing any more
    int filled = 0;  // number of bricks that held nothing, and hold something now; 1 more in another grid
    bool any() const { return appeared || vanished || turned; }
  };
  // Takes over the masks of a volume. It compares the bricks whose walls may have changed since the last
  // call, by the volume's own record.
  News take(const state::Volume& volume, cpu::Workers& workers);

  const state::Grid& grid() const { return grid_; }
  const state::BitPlane& plane() const { return plane_; }
  const state::BitPlane& solid() const { return solid_; }
  // Returns a bit for each of rows y = 64 w to 64 w + 63 of slice z. It is set if a mask of this row, or of
  // one beside it, changed when the masks were last taken. Only such a row may have other faces than before.
  std::uint64_t changed_about(std::size_t w, int z) const;
  // Returns the cells of a word that changed then, or have a neighbour beyond a face that did. Only these may
  // have other faces than before.
  std::uint64_t cells_about(std::size_t w, int y, int z) const;

  bool contains(const Cell& cell) const { return grid_.contains(cell[0], cell[1], cell[2]); }
  bool test(const Cell& cell) const { return contains(cell) && holds(place(brick_at(cell), cell)); }

  // These functions go by bricks. A place is 512 times the number of a brick, and the number of a cell in it.
  const state::Grid& bricks() const { return bricks_; }
  std::size_t brick_at(const Cell& cell) const {
    return bricks_.index(cell[0] >> 3, cell[1] >> 3, cell[2] >> 3);
  }
  bool empty(std::size_t brick) const { return contents_[brick] == kEmpty; }
  bool full(std::size_t brick) const { return contents_[brick] == kFull; }
  static std::size_t place(std::size_t brick, const Cell& cell) {
    return brick << 9 | ((cell[2] & 7) << 6 | (cell[1] & 7) << 3 | (cell[0] & 7));
  }
  bool holds(std::size_t place) const { return (bytes()[place >> 3] >> (place & 7) & 1) != 0; }
  // Returns the cells of a brick, a byte for each row: rows by y, then by z.
  const std::uint8_t* rows(std::size_t brick) const { return bytes() + (brick << 6); }
  // Tells if a ray from this cell on can meet nothing in the rest of the brick. `octant` is that of
  // BrickWalk.
  bool clear_ahead(std::size_t brick, const Cell& cell, std::size_t octant) const;

 private:
  enum Contents : std::uint8_t { kEmpty, kPartly, kFull, kUnknown };
  void resize(const state::Grid& grid);
  News take_layer(const state::Volume& volume, int layer);
  void forget_changes(int z);
  static void note_appeared(const Box& box, News& news);
  std::uint64_t words_that_may_differ(const state::Volume& volume, int y, int z) const;
  void take_row(const state::Volume& volume, std::uint64_t words, int y, int z, News& news);
  void take_word(std::uint64_t now_solid, std::uint64_t now_opaque, std::size_t w, int y, int z, News& news);
  int write_bricks(std::uint64_t was, std::uint64_t is, std::size_t w, int y, int z);
  int look_into(int layer);
  std::size_t change_word(std::size_t y, std::size_t z) const { return z * column_words_ + y / 64; }
  std::uint8_t* bytes() { return reinterpret_cast<std::uint8_t*>(bits_.data()); }
  const std::uint8_t* bytes() const { return reinterpret_cast<const std::uint8_t*>(bits_.data()); }

  state::Grid grid_, bricks_;
  state::ChangedBricks::Seen seen_;  // of the volume that was last taken
  state::BitPlane plane_, solid_;
  state::Pages bits_;                   // 64 bytes a brick
  std::vector<Contents> contents_;      // by bricks
  std::size_t column_words_ = 0;        // words of the rows of a slice
  std::vector<std::uint64_t> changed_;  // by slices: a bit for each row
  state::BitPlane changed_cells_;       // 0 in all other rows
};

}  // namespace voxmelt::visibility
