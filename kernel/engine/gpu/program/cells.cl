// The state lies in linear memory, x fastest, with a border around it that is inert and flat. So no kernel asks
// whether a neighbour lies inside. Rows share their border with the next row, and slices with the next slice.
//
//   F  a byte per cell: bit 0 solid, bit 1 inert, bits 4..7 the material. Liquid is what is not blocked and holds
//      an amount.
//   A, E, H  amount, energy, heat. E and H are 0 where a cell holds nothing.
//   T  what melt found in this step: MELTED and FROZEN cells, and those that are SET. 0 elsewhere, and before melt.
#define ONE 4096
#define AMOUNT_MAX 65535
#define HEAT_MAX 65535
#define BED_HALF 2048

#define SOLID 1u
#define INERT 2u
#define BLOCKED 3u
#define MATERIAL_SHIFT 4

#define MELTED 1u
#define FROZEN 2u
#define SET 4u

#define BRICK_X 32
#define BRICK_Y 4
#define BRICK_Z 4

#define CONSTANTS GLOBAL const long* P

FN int imin(int a, int b) { return a < b ? a : b; }
FN int imax(int a, int b) { return a > b ? a : b; }
FN long lmin(long a, long b) { return a < b ? a : b; }
FN long lmax(long a, long b) { return a > b ? a : b; }
FN int iclamp(int a, int low, int high) { return imax(low, imin(a, high)); }

FN int scaled(int a, int fraction, int offset) { return (int)(((long)a * fraction + offset) >> 16); }

FN int bits_reversed(uint step) {
  uint r = step & 0xFFFFu;
  r = ((r & 0x5555u) << 1) | ((r >> 1) & 0x5555u);
  r = ((r & 0x3333u) << 2) | ((r >> 2) & 0x3333u);
  r = ((r & 0x0F0Fu) << 4) | ((r >> 4) & 0x0F0Fu);
  r = ((r & 0x00FFu) << 8) | ((r >> 8) & 0x00FFu);
  return (int)r;
}
FN int dither_part(int dither, int part, int parts) { return (int)(((uint)dither + 65536u * (uint)part / (uint)parts) & 0xFFFFu); }

// The content and the offset of one cell fit 32 bits: an amount is at most AMOUNT_MAX, and so is each heat.
FN int mixed(uint content, uint amount, int dither) { return (int)((content + ((amount * (uint)dither) >> 16)) / amount); }

FN int is_blocked(uint f) { return (f & BLOCKED) != 0u; }
FN int is_matter(uint f, int a) { return (f & INERT) == 0u && a > 0; }
FN int is_liquid(uint f, int a) { return (f & BLOCKED) == 0u && a > 0; }
FN int is_air(uint f, int a) { return (f & BLOCKED) == 0u && a == 0; }

FN int cell_at(CONSTANTS, int x, int y, int z) { return FIRST + z * SLICE + y * ROW + x; }
// Bricks have a border, too.
FN int brick_at(CONSTANTS, int bx, int by, int bz) { return ((bz + 1) * BRICKS_Y + by + 1) * BRICKS_X + bx + 1; }
FN int brick_of(CONSTANTS, int x, int y, int z) { return brick_at(P, x / BRICK_X, y / BRICK_Y, z / BRICK_Z); }

// The directions of docs/automaton.md, section 2.
FN int direction_x(int d) { return ((2642 >> (2 * d)) & 3) - 1; }
FN int direction_z(int d) { return ((8741 >> (2 * d)) & 3) - 1; }
FN int opposite(int d) { return (int)((0x45672301u >> (4 * d)) & 7u); }

// Visits the cells of listed bricks. The body begins with CELL.
#define FOR_LISTED_CELLS(list, count)                                                                          \
  for (int listed_ = GROUP; listed_ < (count); listed_ += GROUPS)                                              \
    for (int brick = (list)[listed_], x0_ = (brick % BRICKS_X - 1) * BRICK_X,                                  \
             y0_ = (brick / BRICKS_X % BRICKS_Y - 1) * BRICK_Y, z0_ = (brick / (BRICKS_X * BRICKS_Y) - 1) * BRICK_Z, \
             once_ = 1;                                                                                        \
         once_ != 0; once_ = 0)                                                                                \
      for (int lz_ = 0; lz_ < BRICK_Z; ++lz_)                                                                  \
        for (int ly_ = LANE_Y; ly_ < BRICK_Y; ly_ += LANES_Y)                                                  \
          for (int lx_ = LANE_X; lx_ < BRICK_X; lx_ += LANES_X)
#define CELL                                                                                                   \
  int x = x0_ + lx_, y = y0_ + ly_, z = z0_ + lz_;                                                             \
  if (x >= NX || y >= NY || z >= NZ) continue;                                                                 \
  int i = cell_at(P, x, y, z);

// Visits the columns of listed blocks of columns. The body begins with COLUMN.
#define FOR_LISTED_COLUMNS(list, count)                                                                        \
  for (int listed_ = GROUP; listed_ < (count); listed_ += GROUPS)                                              \
    for (int block_ = (list)[listed_], x0_ = (block_ % BRICKS_X - 1) * BRICK_X,                                \
             z0_ = (block_ / BRICKS_X - 1) * BRICK_Z, once_ = 1;                                               \
         once_ != 0; once_ = 0)                                                                                \
      for (int lz_ = LANE_Y; lz_ < BRICK_Z; lz_ += LANES_Y)                                                    \
        for (int lx_ = LANE_X; lx_ < BRICK_X; lx_ += LANES_X)
#define COLUMN                                                                                                 \
  int x = x0_ + lx_, z = z0_ + lz_;                                                                            \
  if (x >= NX || z >= NZ) continue;

// Every term of the ledgers has a slot in each group, so no sum waits for another. The host adds them up.
#define MASS_ADDED 0
#define MASS_REMOVED 1
#define ENERGY_MELTED 2
#define ENERGY_FROZEN 3
#define ENERGY_ADDED 4
#define ENERGY_REMOVED 5
#define ENERGY_REHEATED 6
#define ENERGY_ACCELERATED 7
#define ENERGY_DISSIPATED 8
#define ENERGY_CAPPED 9
#define HEAT_CONDUCTED 10
#define HEAT_WALLS 11
#define HEAT_CONVECTED 12
#define HEAT_RADIATED 13
#define HEAT_WARMED 14
#define HEAT_COOLED 15
#define HEAT_MELTED 16
#define HEAT_ADDED 17
#define HEAT_REMOVED 18
#define HEAT_ROUNDED 19
#define LIMIT_CELLS 20
#define LIMIT_LIMITED_CELLS 21
#define LIMIT_MASS 22
#define LIMIT_LIMITED_MASS 23
#define LIGHT_CUT 24  // how often a cell was cut at the largest irradiance, and how many rays were cast: no ledger
#define LIGHT_RAYS 25
#define TERMS 26

FN void book(GLOBAL long* books, LOCAL long* scratch, int term, long value) {
  scratch[LANE] = value;
  BARRIER;
  for (int half_ = LANES / 2; half_ > 0; half_ /= 2) {
    if (LANE < half_) scratch[LANE] += scratch[LANE + half_];
    BARRIER;
  }
  if (LANE == 0) books[GROUP * TERMS + term] += scratch[0];
  BARRIER;
}

// Returns the heat of a cell whose contents were mixed, and adds what the rounding changes.
FN int mix(uint content, uint amount, int dither, PRIVATE long* rounded) {
  int h = mixed(content, amount, dither);
  *rounded += (long)amount * h - (long)content;
  return h;
}
