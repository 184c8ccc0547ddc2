// Columns, their ground and the levels of their puddles (docs/picture/field.md, sections 3 and 4). Numbers of a kind
// lie together, by column.
#define FILM 0  // the host reads the first three
#define BED 1
#define OFFSET_OF 2
#define TOP_OF 3
#define WET 4
#define FLOOR_OF 5
#define END_OF 6
#define LEVEL_OF 7
#define DEPTH_OF 8
#define COLUMN_KINDS 9
#define COLUMN_NUMBER(kind) columns[(kind) * COLUMNS_OF_ALL + n]

#define FULL_FILM 614
#define NO_LEVEL (-2147483647 - 1)
#define MOST_SHIFT 1024

FN int part_of_cell(uint f, int a) { return (f & INERT) != 0u ? 0 : imin(a, ONE); }

// The largest amount of liquid with nothing solid or inert above it, if that is more than two cells, or 0. It tells who
// watches a run that a vent fills the grid up to its top.
FN int pressed_in(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, int first) {
  int most = 2 * ONE;
  for (int y = NY - 1; y >= 0 && !is_blocked(F[first + y * ROW]); --y) most = imax(most, A[first + y * ROW]);
  return most > 2 * ONE ? most : 0;
}

// `heights` are those of the terrain, in cells, if there is one. `pressed` gets the largest amount of all columns.
KERNEL(find_columns)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const int* heights,
                     int has_heights, GLOBAL int* columns, GLOBAL int* pressed) {
  FOR_COLUMNS(n) {
    int first = cell_at(P, n % NX, 0, n / NX);
    int highest = has_heights ? imin(heights[n], NY) : NY, bed = 0;
    while (bed < highest && (F[first + bed * ROW] & INERT) != 0u) ++bed;
    int top = bed;
    for (int y = bed; y < NY; ++y)
      if ((F[first + y * ROW] & INERT) != 0u) top = y + 1;
    int at_bed = first + bed * ROW, offset = 0, film = 0, wet = 0;
    if (bed > 0) {
      offset = iclamp((int)A[at_bed - ROW] - BED_HALF, -BED_HALF, BED_HALF);
      if (bed < NY) film = imin(part_of_cell(F[at_bed], A[at_bed]), FULL_FILM) * ONE / FULL_FILM;
      wet = bed < NY && (F[at_bed] & INERT) != 0u ? ONE : film;
    }
    int floor_ = bed < NY && is_liquid(F[at_bed], A[at_bed]) ? bed : top, end = floor_, depth = 0;
    for (; end < NY && is_liquid(F[first + end * ROW], A[first + end * ROW]); ++end)
      depth += imin(A[first + end * ROW], ONE);
    int puddle = floor_ > 0 && depth > 0 && end < NY;
    if (puddle) puddle = is_air(F[first + end * ROW], A[first + end * ROW]);
    int most = pressed_in(P, F, A, first);
    if (most > 0) RAISE_TO(pressed, most);
    COLUMN_NUMBER(BED) = bed;
    COLUMN_NUMBER(TOP_OF) = top;
    COLUMN_NUMBER(OFFSET_OF) = offset;
    COLUMN_NUMBER(FILM) = film;
    COLUMN_NUMBER(WET) = wet;
    COLUMN_NUMBER(FLOOR_OF) = floor_;
    COLUMN_NUMBER(END_OF) = end;
    COLUMN_NUMBER(LEVEL_OF) = puddle ? floor_ * ONE + depth + (floor_ == bed ? offset : 0) : NO_LEVEL;
    COLUMN_NUMBER(DEPTH_OF) = depth;
  }
}

// Levels count in sixteenths between passes.
KERNEL(begin_levels)(CONSTANTS, GLOBAL const int* columns, GLOBAL int* levels) {
  FOR_COLUMNS(n) {
    int level = COLUMN_NUMBER(LEVEL_OF);
    levels[n] = level == NO_LEVEL ? NO_LEVEL : 16 * level;
  }
}

FN int level_at(CONSTANTS, GLOBAL const int* levels, int x, int z) {
  return x < 0 || z < 0 || x >= NX || z >= NZ ? NO_LEVEL : levels[z * NX + x];
}
FN int level_share(int difference) {
  return iclamp(8192 - ((difference < 0 ? -difference : difference) >> 4), 0, ONE);
}
FN int level_bend(int before, int here, int after) {
  if (before == NO_LEVEL || after == NO_LEVEL) return 0;
  int share = imin(level_share(before - here), level_share(after - here));
  return (int)(((long)(before - here + after - here) * share) >> 12);
}

KERNEL(smooth_levels)(CONSTANTS, GLOBAL const int* from, GLOBAL int* to) {
  FOR_COLUMNS(n) {
    int x = n % NX, z = n / NX, here = from[n];
    if (here == NO_LEVEL) {
      to[n] = NO_LEVEL;
      continue;
    }
    int straight = level_bend(level_at(P, from, x - 1, z), here, level_at(P, from, x + 1, z)) +
                   level_bend(level_at(P, from, x, z - 1), here, level_at(P, from, x, z + 1));
    int diagonal = level_bend(level_at(P, from, x - 1, z - 1), here, level_at(P, from, x + 1, z + 1)) +
                   level_bend(level_at(P, from, x - 1, z + 1), here, level_at(P, from, x + 1, z - 1));
    to[n] = here + ((2 * straight + diagonal) >> 4);
  }
}
