// The inner loops compute the density field. They are compiled once for each instruction set and chosen at
// run time. All give the same bits.
#pragma once

#include <cstddef>
#include <cstdint>

#include "kernel/engine/cpu/instruction_set.h"
#include "render/density/brick.h"

namespace voxmelt::render {

// Points to cells of a block, [z][y][x]. There are `row` cells from one row to the next, and `slice` from one
// slice to the next.
template <class T>
struct Block {
  T* cells;
  std::size_t row, slice;
};

// Describes one brick of a volume, with x * y * z cells, and its kept values.
struct MatterBrick {
  int x, y, z;
  const std::uint64_t *solid, *liquid;  // the words that hold the brick's first row
  std::size_t mask_row, mask_slice;     // words from one row or slice to the next
  int shift;                            // shift of the brick's bits in the word
  Block<const std::uint16_t> amount, heat;
  Block<const std::uint8_t> material;  // null: all are the first one
  Block<std::uint16_t> to_solid, to_liquid, to_heat;
  bool kept_solid, kept_liquid, kept_heat;  // if false, the kept values are 0 in all of the brick
  bool with_heat;
  const std::uint8_t* tones;  // by material; if not null, the heat holds the tone of solids (tones.h)
};

// Tells where cells have changed.
struct MatterFound {
  BrickPart solid, liquid, heat;
};

// Points to three rows of the levels of puddles, from the first wanted column. One column before the wanted
// ones and one after them is read, too.
struct LevelRows {
  const std::int32_t *low, *here, *high;
};

inline constexpr int kLanes = 16;  // cells that a loop takes at once

// The loops read cells beyond the wanted ones only if a comment says so, because another thread may be
// writing them.
struct Loops {
  // Takes over what is solid and liquid in a brick. Rows of masks and amounts are read to their end.
  MatterFound (*matter)(const MatterBrick& brick);

  // Makes one pass of the 3x3x3 binomial filter (docs/picture/field.md, section 6). It gives x * y * z cells
  // of `to` from two more along each axis of `from`, which may be `to`. Rows of `to` are written up to the
  // next multiple of kLanes. Rows of `from` are read up to 2 kLanes further than x + 2. `room` has 2 (x + 2 +
  // 3 kLanes) (y + 2) cells.
  void (*low_pass)(Block<const std::uint16_t> from, Block<std::uint16_t> to, int x, int y, int z,
                   std::uint16_t* room);

  // Computes how much of the liquid's filter each cell gets, 0..256, from the liquid and the solid around it.
  // `obstacle` is null without obstacles. Whole groups are written.
  void (*weights)(const std::uint16_t* liquid, const std::uint16_t* solid, const std::uint16_t* obstacle,
                  int count, std::uint16_t* weights);

  // Computes to = ((256 - weight) solid + weight liquid) / 256, to nearest. Whole groups are read.
  void (*mix)(const std::uint16_t* solid, const std::uint16_t* liquid, const std::uint16_t* weights,
              int count, std::uint16_t* to);

  // Makes one pass along the levels of puddles (docs/picture/field.md, section 4).
  void (*smooth_levels)(const LevelRows& from, int count, std::int32_t* to);
};

// Returns the loops, compiled for an architecture of xsimd (density_loops.h).
template <class Arch>
Loops loops_for();

// Returns the loops for a processor whose best instruction set is this one.
const Loops& loops_of(cpu::InstructionSet widest);
const Loops& loops();  // the best that this processor can run

}  // namespace voxmelt::render
