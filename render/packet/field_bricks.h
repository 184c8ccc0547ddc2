// The ray caster reads the field in this form. It has bricks of levels and of matter, and tells which parts
// are empty (docs/picture/definition.md, section 12).
//
// The lattice holds the cells -2 .. n + 1 of each axis, so a lattice place is cell + 2. Brick b covers
// samples whose lower cell lies in the places 8 b .. 8 b + 7. It holds the 11 places from 8 b - 1 along each
// axis, so samples and normals read one brick alone. Bricks with nothing but air share one.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel/engine/cpu/workers.h"
#include "render/brick/brick_loops.h"
#include "render/density/density_field.h"
#include "render/packet/picture_data.h"
#include "render/rule/look.h"
#include "render/rule/sample.h"

namespace voxmelt::render {

inline constexpr int kBrickPlaces = kBrickSide + 3;  // places along an axis of a brick
inline constexpr int kBrickVolume = kBrickPlaces * kBrickPlaces * kBrickPlaces;

class FieldBricks {
 public:
  // Takes over a field. `changed` lists the bricks of the field (DensityField::bricks) that were filtered
  // again since the last call, or is null for all. Another grid or look asks for all.
  void update(const DensityField& field, const picture::Look& look, const std::vector<std::uint32_t>* changed,
              cpu::Workers& workers, const BrickLoops& loops = brick_loops());

  picture::Vector cells() const { return cells_; }
  const state::Grid& bricks() const { return bricks_; }
  const state::Grid& blocks() const { return blocks_; }

  // Returns for each brick the slot that holds its places. Slot 0 is the brick of air.
  const std::int32_t* slots() const { return slots_.data(); }
  // Both are [slot][z][y][x]. Matter is liquid + 256 heat + 65536 obstacle.
  const std::int16_t* levels() const { return levels_.data(); }
  const std::uint32_t* matter() const { return matter_.data(); }
  // Returns one number for each block of 4 x 4 x 4 lower cells. If one of its places is matter, the low byte
  // bounds the slope (see slope_bound), and the slot of its brick is above it. Otherwise it is negative, and
  // the low byte tells how many blocks away the nearest such block is, kFarthest at most.
  const std::int32_t* records() const { return records_.data(); }
  static constexpr int kFarthest = 16;
  // Returns a bound of the slope. Within a block, the level changes by no more than kSlopeUnit times this
  // over a way with a largest component of one cell. Roundings of samples are not counted. Neighbours differ
  // by 65280 at most, at a side of the grid. So a byte suffices, even in a corner of it.
  static int slope_bound(int along_x, int along_y, int along_z) {
    return (along_x + along_y + along_z + kSlopeUnit - 1) / kSlopeUnit;
  }
  // Bounds the box low <= position < high. Every sample outside of it is air.
  struct Box {
    picture::Vector low, high;
  };
  const Box& occupied() const { return box_; }
  // Returns boxes that hold all occupied blocks, except those that are surrounded by such blocks on all
  // sides.
  const std::vector<BlockBox>& shell() const { return shell_; }
  std::size_t bytes() const;

 private:
  // Tells what an update must do.
  struct Stale {
    std::vector<std::uint8_t> source;   // bricks of the field that have changed, or are wanted whole
    std::vector<std::uint8_t> touched;  // bricks of places that may change, and after fill_all those that did
  };
  void find_stale(const DensityField& field, const std::vector<std::uint32_t>& changed, Stale& stale) const;
  // Returns the touched bricks that have a slot. `moved` becomes true if a block has lost its matter.
  std::vector<std::size_t> give_slots(const DensityField& field, Stale& stale, bool& moved);
  void fill_all(const DensityField& field, const picture::Look& look, Stale& stale, cpu::Workers& workers,
                const BrickLoops& loops);

  void resize(const state::Grid& grid);
  std::int32_t take();
  void give_back(std::int32_t& slot);
  std::size_t block_of(std::size_t brick, int which) const;  // 0 .. 7
  bool anything_near(const DensityField& field, const state::Grid& brick) const;
  bool clear(std::size_t brick);
  bool fill(const DensityField& field, const MatterSource& matter, std::size_t brick, bool whole,
            const BrickLoops& loops);
  bool find_ranges(std::size_t brick, const BrickLoops& loops);
  void find_distances();
  void find_box();
  void find_shell();

  picture::Vector cells_;
  state::Grid grid_{0, 0, 0}, bricks_{0, 0, 0}, blocks_{0, 0, 0};
  std::vector<std::int32_t> slots_;
  std::vector<std::int32_t> free_;
  std::vector<std::int16_t> levels_;
  std::vector<std::uint32_t> matter_;
  std::vector<std::int32_t> records_;
  std::vector<std::uint8_t> occupied_;  // by blocks
  std::vector<std::uint8_t> mixed_;     // by bricks of the field, 1 if some word of matter is not 0
  Box box_;
  std::vector<BlockBox> shell_;
};

}  // namespace voxmelt::render
