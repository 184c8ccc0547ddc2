// Which cells are opaque, and how a ray walks through them (docs/automaton.md, section 5). It is the walk of
// kernel/engine/visibility/two_level.h with other bricks: what is empty is passed at once, by blocks and by cubes, and
// elsewhere the ray goes from cell to cell.
//
//   cubes   a word for each cube of 4x4x4 cells, eight in a row for each brick. A bit is set if its cell lies in the
//           grid, and is solid or inert. So the border is transparent here, as it must be.
//   blocks  a word for each block of 4x4x4 cubes. A bit is set if its cube is not 0.
#define CUBE 4
#define BLOCK 16
#define BRICK_CUBES 8
#define BLOCKS_X ((NX + BLOCK - 1) / BLOCK)
#define BLOCKS_Y ((NY + BLOCK - 1) / BLOCK)
#define BLOCKS_Z ((NZ + BLOCK - 1) / BLOCK)
#define UNIT 16  // a cell, in the unit of positions

// The place of a cell in the word of its cube, and of a cube in that of its block.
FN int place_in_word(int x, int y, int z) { return (z & 3) << 4 | (y & 3) << 2 | (x & 3); }
FN int cube_at(CONSTANTS, int x, int y, int z) {
  return BRICK_CUBES * brick_of(P, x, y, z) + (x / CUBE) % BRICK_CUBES;
}
FN int block_at(CONSTANTS, int x, int y, int z) { return (z / BLOCK * BLOCKS_Y + y / BLOCK) * BLOCKS_X + x / BLOCK; }

KERNEL(find_cubes)(CONSTANTS, GLOBAL const uchar* F, GLOBAL ulong* cubes) {
  for (int n = GROUP * LANES + LANE; n < BRICK_CUBES * BRICKS_X * BRICKS_Y * BRICKS_Z; n += GROUPS * LANES) {
    int brick = n / BRICK_CUBES, x0 = (brick % BRICKS_X - 1) * BRICK_X + n % BRICK_CUBES * CUBE;
    int y0 = (brick / BRICKS_X % BRICKS_Y - 1) * BRICK_Y, z0 = (brick / (BRICKS_X * BRICKS_Y) - 1) * BRICK_Z;
    ulong word = 0;
    for (int z = imax(0, z0); z < imin(NZ, z0 + CUBE); ++z)
      for (int y = imax(0, y0); y < imin(NY, y0 + CUBE); ++y)
        for (int x = imax(0, x0); x < imin(NX, x0 + CUBE); ++x)
          word |= (ulong)is_blocked(F[cell_at(P, x, y, z)]) << place_in_word(x, y, z);
    cubes[n] = word;
  }
}

KERNEL(find_blocks)(CONSTANTS, GLOBAL const ulong* cubes, GLOBAL ulong* blocks) {
  for (int n = GROUP * LANES + LANE; n < BLOCKS_X * BLOCKS_Y * BLOCKS_Z; n += GROUPS * LANES) {
    int x0 = n % BLOCKS_X * BLOCK, y0 = n / BLOCKS_X % BLOCKS_Y * BLOCK, z0 = n / (BLOCKS_X * BLOCKS_Y) * BLOCK;
    ulong word = 0;
    for (int z = z0; z < imin(NZ, z0 + BLOCK); z += CUBE)
      for (int y = y0; y < imin(NY, y0 + BLOCK); y += CUBE)
        for (int x = x0; x < imin(NX, x0 + BLOCK); x += CUBE)
          word |= (ulong)(cubes[cube_at(P, x, y, z)] != 0) << place_in_word(x / CUBE, y / CUBE, z / CUBE);
    blocks[n] = word;
  }
}

typedef struct {
  int x, y, z;
} Triple;

// A ray on its way: the cell where it is, and for each axis which way it goes, how far the next plane lies from its
// start, and how far its end. So it crosses that plane at the fraction ahead / length of its way. Two fractions are
// compared by products of 43 bits: 26 of a length (docs/proofs.md, "Widths"), and 17 of a plane in the grid or in a
// block beyond its end. Where a length is 0, ahead is not, and no plane is ever crossed.
typedef struct {
  Triple cell, way, ahead, length;
} Walk;

FN int way_along(int length) { return length > 0 ? 1 : -1; }
FN int ahead_along(int cell, int start, int length) {
  return length > 0 ? UNIT * (cell + 1) - start : start - UNIT * cell;
}
FN int size_of(int a) { return a < 0 ? -a : a; }
FN Walk walk_of(Triple cell, Triple start, Triple end) {
  int dx = end.x - start.x, dy = end.y - start.y, dz = end.z - start.z;
  Walk w = {cell,
            {way_along(dx), way_along(dy), way_along(dz)},
            {ahead_along(cell.x, start.x, dx), ahead_along(cell.y, start.y, dy), ahead_along(cell.z, start.z, dz)},
            {size_of(dx), size_of(dy), size_of(dz)}};
  return w;
}

// Is below 0 if the first fraction is the lesser one, and 0 if they are equal.
FN long order_of(int ahead, int length, int other_ahead, int other_length) {
  return (long)ahead * other_length - (long)other_ahead * length;
}

// Moves to the next cell, along all axes whose planes are crossed at once. Returns 0 if the ray ends first.
FN int next_cell(PRIVATE Walk* w) {
  long xy = order_of(w->ahead.x, w->length.x, w->ahead.y, w->length.y);
  long yz = order_of(w->ahead.y, w->length.y, w->ahead.z, w->length.z);
  long zx = order_of(w->ahead.z, w->length.z, w->ahead.x, w->length.x);
  int on_x = xy <= 0 && zx >= 0, on_y = yz <= 0 && xy >= 0, on_z = zx <= 0 && yz >= 0;
  if ((on_x && w->ahead.x >= w->length.x) || (on_y && w->ahead.y >= w->length.y) ||
      (on_z && w->ahead.z >= w->length.z))
    return 0;
  w->cell.x += on_x ? w->way.x : 0;
  w->cell.y += on_y ? w->way.y : 0;
  w->cell.z += on_z ? w->way.z : 0;
  w->ahead.x += on_x ? UNIT : 0;
  w->ahead.y += on_y ? UNIT : 0;
  w->ahead.z += on_z ? UNIT : 0;
  return 1;
}

// Returns how far the last plane lies that an axis crosses on its way out of a box of `side` cells.
FN int exit_along(int cell, int way, int ahead, int side) {
  int inside = cell & (side - 1);
  return ahead + UNIT * (way > 0 ? side - 1 - inside : inside);
}
// Returns how many planes an axis crosses until the fraction exit / exit_length. In a box of `side` cells there are at
// most so many.
FN int planes_until(int exit, int exit_length, int ahead, int length, int side) {
  long rest = order_of(exit, exit_length, ahead, length);
  long each = (long)UNIT * exit_length;
  if (rest < 0) return 0;
  int planes = 1;
  for (int k = side / 2; k > 0; k /= 2)
    if (rest >= k * each) {
      rest -= k * each;
      planes += k;
    }
  return planes;
}

// Moves to the first cell beyond the box of `side` cells where it is. Returns 0 if the ray ends first.
FN int leave(PRIVATE Walk* w, int side) {
  int exit = exit_along(w->cell.x, w->way.x, w->ahead.x, side), length = w->length.x;
  int exit_y = exit_along(w->cell.y, w->way.y, w->ahead.y, side);
  if (order_of(exit_y, w->length.y, exit, length) < 0) {
    exit = exit_y;
    length = w->length.y;
  }
  int exit_z = exit_along(w->cell.z, w->way.z, w->ahead.z, side);
  if (order_of(exit_z, w->length.z, exit, length) < 0) {
    exit = exit_z;
    length = w->length.z;
  }
  if (exit >= length) return 0;
  int on_x = planes_until(exit, length, w->ahead.x, w->length.x, side);
  int on_y = planes_until(exit, length, w->ahead.y, w->length.y, side);
  int on_z = planes_until(exit, length, w->ahead.z, w->length.z, side);
  w->cell.x += on_x * w->way.x;
  w->cell.y += on_y * w->way.y;
  w->cell.z += on_z * w->way.z;
  w->ahead.x += UNIT * on_x;
  w->ahead.y += UNIT * on_y;
  w->ahead.z += UNIT * on_z;
  return 1;
}

FN int is_inside(CONSTANTS, Triple c) { return c.x >= 0 && c.x < NX && c.y >= 0 && c.y < NY && c.z >= 0 && c.z < NZ; }

// Tells if a ray comes to its end, or out of the grid, and meets no opaque cell.
FN int sees(CONSTANTS, GLOBAL const ulong* cubes, GLOBAL const ulong* blocks, Walk w) {
  while (is_inside(P, w.cell)) {
    Triple first = w.cell;
    ulong block = blocks[block_at(P, first.x, first.y, first.z)];
    if (((block >> place_in_word(first.x / CUBE, first.y / CUBE, first.z / CUBE)) & 1u) == 0) {
      if (!leave(&w, block == 0 ? BLOCK : CUBE)) return 1;
      continue;
    }
    ulong cube = cubes[cube_at(P, first.x, first.y, first.z)];
    do {
      if (((cube >> place_in_word(w.cell.x, w.cell.y, w.cell.z)) & 1u) != 0) return 0;
      if (!next_cell(&w)) return 1;
    } while ((((w.cell.x ^ first.x) | (w.cell.y ^ first.y) | (w.cell.z ^ first.z)) & ~(CUBE - 1)) == 0);
  }
  return 1;
}
