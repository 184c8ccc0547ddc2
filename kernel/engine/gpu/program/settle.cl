// Phase `excess` of the viscous law (docs/automaton.md, section 10): runs settle, and show what they are.
#define HEAD_ONE 512
#define NO_BED (-1)

// What a cell shows to its neighbours. A run has one record, at its lowest cell.
typedef struct {
  int head, mobility, exposed, dead, bed, limit;
  int cells;  // that hold something once it has settled
  int shut;
} Column;

FN int bed_of_solid(CONSTANTS, GLOBAL const int* tables, int a, int h, int material) {
  GLOBAL const int* row = tables + MATERIAL_ROWS + material * MATERIAL_ROW;
  int part = ONE;
  if (HEAT) {
    long lack = iclamp(row[5] - h, 0, row[6]);
    part = (int)((lack << row[7]) * row[8] >> 16);
  }
  return ((imin(a, ONE + BED_HALF - 1) * part) >> 12) - BED_HALF;
}
// Returns the head of the bed on which the cell above i stands, at height y.
FN int bed_head(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                GLOBAL const ushort* H, int i, int y) {
  uint f = F[i];
  int a = A[i];
  int bed = (f & INERT) != 0u ? a : bed_of_solid(P, tables, a, HEAT ? H[i] : 0, (int)(f >> MATERIAL_SHIFT));
  return y * HEAD_ONE + ((bed - BED_HALF) >> 3);
}

FN long warmed(CONSTANTS, long mobility, int h) {
  int octaves = ((h - MOBILITY_REFERENCE) * MOBILITY_RATE) >> 6;
  int x = iclamp(octaves, -(1 << 21), (1 << 19) - 1);
  uint f = (uint)x & 0xFFFFu;
  uint power = 4096u + ((f * (43057u + ((22479u * f) >> 16))) >> 20);
  return (mobility * power) >> (12 - (x >> 16));
}
FN long run_mobility(CONSTANTS, long mass, int h, int substeps) {
  ulong pace = ((ulong)MOBILITY + (ulong)(substeps / 2)) / (ulong)substeps;
  ulong depth = (ulong)lmin(mass, 64 * ONE);
  long mobility = (long)((pace * ((depth * depth) >> 8) + (1u << 23)) >> 24);
  return THERMAL ? warmed(P, mobility, h) : mobility;
}
FN int run_limit(CONSTANTS, long mass, long over, int reach, int bits) {
  long one = 13107 / ((mass >> 12) + 1) / (over > 0 ? STIFFNESS : 1);
  return (int)lmax(1, (one * reach) >> bits);
}
FN int run_continues(long mass, int n, int top, int next) {
  return mass > (long)n * ONE || (top >= ONE / 2 && next > 0);
}
FN int settled(long mass, int n, int k) {
  long over = lmax(0, mass - (long)n * ONE);
  long base = lmax(0, lmin(mass - (long)k * ONE, ONE));
  long stacked = lmax(0, lmin(over - (long)(AMOUNT_MAX - ONE) * (n - 1 - k), AMOUNT_MAX - ONE));
  return (int)(base + stacked);
}

typedef struct {
  long mass;
  ulong content;
  int n;
  int keeps_order;
} Run;

// Gathers the run that begins at cell i.
FN Run gathered(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const ushort* H, int i) {
  Run run = {0, 0, 0, 1};
  int next = A[i];
  while (next > 0 || run.mass > (long)run.n * ONE) {
    int top = next, at = i + run.n * ROW;
    if (run.n > 0) {
      long excess = run.mass - (long)run.n * ONE;
      if (excess > AMOUNT_MAX - ONE || excess < -(AMOUNT_MAX - ONE)) run.keeps_order = 0;
    }
    run.mass += top;
    if (HEAT) run.content += (ulong)top * H[at];
    ++run.n;
    if (is_blocked(F[at + ROW])) break;
    next = A[at + ROW];
    if (!run_continues(run.mass, run.n, top, next)) break;
  }
  if (run.mass > (long)run.n * ONE) run.keeps_order = 0;
  return run;
}

FN int mixed_heat(uint to, int h, uint flow, int g, int dither) {
  return mixed(to * (uint)h + flow * (uint)g, to + flow, dither);
}

// Moves the heat through the faces of a run that keeps its order, first upwards and then downwards. `came` keeps
// the amounts as they came. A and H change.
FN void move_in_order(CONSTANTS, GLOBAL ushort* A, GLOBAL ushort* H, GLOBAL ushort* came, int i, Run run, int dither) {
  long below = 0;
  for (int k = 0; k < run.n; ++k) came[i + k * ROW] = A[i + k * ROW];
  for (int k = 0; k < run.n - 1; ++k) {
    int at = i + k * ROW, up = at + ROW;
    below += came[at];
    int flow = (int)lmax(0, below - (long)(k + 1) * ONE);
    if (flow == 0) continue;
    H[up] = (ushort)mixed_heat(A[up], H[up], (uint)flow, H[at], dither);
    A[up] = (ushort)(A[up] + flow);
    A[at] = (ushort)(A[at] - flow);
  }
  below = run.mass;
  for (int k = run.n - 2; k >= 0; --k) {
    int at = i + k * ROW, up = at + ROW;
    below -= came[up];
    int flow = (int)lmax(0, lmin((long)(k + 1) * ONE, run.mass) - below);
    if (flow == 0) continue;
    H[at] = (ushort)mixed_heat(A[at], H[at], (uint)flow, H[up], dither);
    A[at] = (ushort)(A[at] + flow);
    A[up] = (ushort)(A[up] - flow);
  }
}

typedef struct {
  long rounded, cells, limited_cells, mass, limited_mass;
} SettleBooks;

FN Column shown_by(CONSTANTS, Run run, int bed, int h, int under_ceiling, int substeps, int reach, int bits,
                   PRIVATE SettleBooks* sums) {
  long over = lmax(0, run.mass - (long)run.n * ONE), excess = run.mass - (long)run.n * ONE;
  int depth = (int)lmax(1, run.mass >> 4);
  long mobility = run_mobility(P, run.mass, h, substeps);
  Column column = {0, 0, 0, 0, 0, 0, 0, 0};
  column.head = bed + (int)(run.mass >> 3) + (STIFFNESS - 1) * (int)(over >> 3);
  column.limit = run_limit(P, run.mass, over, reach, bits);
  long most = (long)column.limit << (8 + bits);
  column.mobility = (int)lmin(mobility, most);
  column.exposed = (int)lmin(mobility, 1 << 21);
  column.dead = (int)lmax(1, (2 * (long)YIELD + depth / 2) / depth);
  column.bed = bed >> 5;
  column.cells = (int)lmin(run.n, (run.mass + ONE - 1) / ONE);
  column.shut = under_ceiling && -ONE / 64 <= excess && excess <= ONE / 64;
  sums->cells += column.cells;
  sums->mass += run.mass;
  if (mobility > most) {
    sums->limited_cells += column.cells;
    sums->limited_mass += run.mass;
  }
  return column;
}

FN int is_same(Column a, Column b) {
  return a.head == b.head && a.mobility == b.mobility && a.exposed == b.exposed && a.dead == b.dead && a.bed == b.bed &&
         a.limit == b.limit && a.cells == b.cells && a.shut == b.shut;
}
// Gives a cell its place in a run, or none. It returns 1 if that is another one than before.
FN int put_place(GLOBAL ushort* run, int i, int place) {
  if (run[i] == place) return 0;
  run[i] = (ushort)place;
  return 1;
}
// Tells that cells show others than before, and so does what lies on the last of them.
FN void show_anew(CONSTANTS, MOMENTS, int x, int y, int z, int cells, int now) {
  for (int k = 0; k <= cells; ++k)
    if (y + k < NY) note(&MOVED_AT(brick_of(P, x, y + k, z)), now);
}
// Takes the cells of a brick out of runs in which they were.
FN void leave_runs(CONSTANTS, MOMENTS, GLOBAL ushort* run, int x, int y, int z, int now) {
  for (int k = 0; k < BRICK_Y && y + k < NY; ++k)
    if (put_place(run, cell_at(P, x, y + k, z), 0)) show_anew(P, moments, x, y + k, z, 1, now);
}

// The counters stand for all runs of a column until it is looked at again. Each group has the sum of what it has found
// of them, and books all of it in every sub-step.
FN void book_limits(GLOBAL long* standing, GLOBAL long* books, LOCAL long* scratch, int term, long value) {
  book(standing, scratch, term, value);
  if (LANE == 0) books[GROUP * TERMS + term] += standing[GROUP * TERMS + term];
}

FN int is_settled(GLOBAL const ushort* A, int row, int i, Run run) {
  int same = 1;
  for (int k = 0; k < run.n; ++k) same &= A[i + k * row] == settled(run.mass, run.n, k);
  return same;
}

// `run` has for each cell of a run its place in it, from 1 on, and 0 elsewhere. `limits` has the counters of each column
// as they were found last. What has changed since the moment `since` may lie elsewhere than before.
KERNEL(settle)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL ushort* A, GLOBAL ushort* H,
               GLOBAL ushort* came, GLOBAL ushort* run, GLOBAL Column* records, GLOBAL long* limits,
               GLOBAL long* standing, GLOBAL long* books, MOMENTS, GLOBAL const int* columns, GLOBAL const int* counts, int substeps, int reach,
               int bits, int dither, int since, int now) {
  SCRATCH
  SettleBooks all = {0, 0, 0, 0, 0};
  FOR_LISTED_COLUMNS(columns, counts[COLUMNS]) {
    COLUMN
    SettleBooks sums = {0, 0, 0, 0, 0};
    for (int y = 0; y < NY; ++y) {
      if (y % BRICK_Y == 0 && !has_matter(P, moments, brick_of(P, x, y, z))) {
        if (LOOK(MOVED_AT(brick_of(P, x, y, z))) > since) leave_runs(P, moments, run, x, y, z, now);
        y += BRICK_Y - 1;  // no run begins without matter
        continue;
      }
      int i = cell_at(P, x, y, z);
      Run one = {0, 0, 0, 1};
      if (!is_blocked(F[i]) && is_blocked(F[i - ROW])) one = gathered(P, F, A, H, i);
      if (one.n == 0) {
        if (put_place(run, i, 0)) show_anew(P, moments, x, y, z, 1, now);
        continue;
      }
      int after = 0, moves = !is_settled(A, ROW, i, one);
      if (HEAT) {
        if (one.keeps_order)
          move_in_order(P, A, H, came, i, one, dither);
        else
          after = (int)((one.content + (((ulong)one.mass * (uint)dither) >> 16)) / (ulong)one.mass);
        sums.rounded -= (long)one.content;
      }
      int bed = bed_head(P, tables, F, A, H, i - ROW, y);
      Column shows = shown_by(P, one, bed, HEAT ? (int)(one.content / (ulong)one.mass) : 0,
                              is_blocked(F[i + one.n * ROW]), substeps, reach, bits, &sums);
      moves |= run[i] != 1 || !is_same(records[i], shows);
      records[i] = shows;
      for (int k = 0; k < one.n; ++k) {
        int at = i + k * ROW, amount = settled(one.mass, one.n, k);
        A[at] = (ushort)amount;
        if (HEAT) {
          int h = one.keeps_order ? H[at] : after;
          sums.rounded += (long)amount * h;
          moves |= amount > 0 && H[at] != h;
          H[at] = (ushort)(amount > 0 ? h : 0);
        }
        moves |= put_place(run, at, amount > 0 ? k + 1 : 0);
        if (amount > 0) note(&MATTER_AT(brick_of(P, x, y + k, z)), now);
      }
      if (moves) show_anew(P, moments, x, y, z, one.n, now);
      y += one.n - 1;
    }
    GLOBAL long* before = limits + 4 * ((long)z * NX + x);
    all.rounded += sums.rounded;
    all.cells += sums.cells - before[0];
    all.limited_cells += sums.limited_cells - before[1];
    all.mass += sums.mass - before[2];
    all.limited_mass += sums.limited_mass - before[3];
    before[0] = sums.cells;
    before[1] = sums.limited_cells;
    before[2] = sums.mass;
    before[3] = sums.limited_mass;
  }
  if (HEAT) book(books, scratch, HEAT_ROUNDED, all.rounded);
  book_limits(standing, books, scratch, LIMIT_CELLS, all.cells);
  book_limits(standing, books, scratch, LIMIT_LIMITED_CELLS, all.limited_cells);
  book_limits(standing, books, scratch, LIMIT_MASS, all.mass);
  book_limits(standing, books, scratch, LIMIT_LIMITED_MASS, all.limited_mass);
}

// Finds the most sub-steps that a run needs.
KERNEL(count_substeps)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const ushort* H,
                       MOMENTS, GLOBAL const int* columns, GLOBAL const int* counts,
                       GLOBAL int* most) {
  FOR_LISTED_COLUMNS(columns, counts[COLUMNS]) {
    COLUMN
    for (int y = 0; y < NY; ++y) {
      if (y % BRICK_Y == 0 && !has_matter(P, moments, brick_of(P, x, y, z))) {
        y += BRICK_Y - 1;
        continue;
      }
      int i = cell_at(P, x, y, z);
      if (!is_liquid(F[i], A[i]) || !is_blocked(F[i - ROW])) continue;
      Run one = gathered(P, F, A, H, i);
      long limit = (long)run_limit(P, one.mass, lmax(0, one.mass - (long)one.n * ONE), 1, 0) << 8;
      long needed = (run_mobility(P, one.mass, HEAT ? (int)(one.content / (ulong)one.mass) : 0, 1) + limit - 1) / limit;
      RAISE_TO(most, (int)lmin(needed, 0x7FFFFFFF));
      y += one.n - 1;
    }
  }
}
