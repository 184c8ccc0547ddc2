// Three lists tell where kernels work: bricks that hold matter, bricks that matter may reach by spreading, and
// blocks of columns that hold matter. The order of a list is any, and no result depends on it.

// Spread writes other buffers than it reads, and no kernel writes where it is not listed. Still both buffers are right
// there: what leaves a brick by spread lies beside it afterwards, so the brick is listed once more and cleared.
#define FULL 0  // where the number of entries of each list stands
#define NEAR 1
#define COLUMNS 2
#define COUNTS 3

// The lists are made twice in a step, with counts of their own. Each time sets those of the other time to 0, and
// `coming`, which spread will fill.
KERNEL(list_bricks)(CONSTANTS, GLOBAL uchar* matter, GLOBAL uchar* coming, GLOBAL int* full, GLOBAL int* near_,
                    GLOBAL int* columns, GLOBAL int* counts, GLOBAL int* other_counts) {
  int plane = BRICKS_X * BRICKS_Y;
  if (GROUP == 0 && LANE < COUNTS)
    for (int k = LANE; k < COUNTS; k += LANES) other_counts[k] = 0;
  for (int n = GROUP * LANES + LANE; n < plane * BRICKS_Z; n += GROUPS * LANES) {
    coming[n] = 0;
    int bx = n % BRICKS_X, by = n / BRICKS_X % BRICKS_Y, bz = n / plane;
    if (bx == 0 || by == 0 || bz == 0 || bx == BRICKS_X - 1 || by == BRICKS_Y - 1 || bz == BRICKS_Z - 1) continue;
    int own = LOOK(matter[n]), any = own;
    for (int dz = -1; dz <= 1; ++dz)
      for (int dx = -1; dx <= 1; ++dx) any |= LOOK(matter[n + dz * plane + dx]);
    if (own != 0) full[NEXT(counts)] = n;
    if (any != 0) near_[NEXT(counts + 1)] = n;
    if (by != 1) continue;
    int column = own;
    for (int k = 1; k < BRICKS_Y - 2; ++k) column |= LOOK(matter[n + k * BRICKS_X]);
    if (column != 0) columns[NEXT(counts + 2)] = bz * BRICKS_X + bx;
  }
}

// Finds the bricks that hold matter in a state that has just come.
KERNEL(find_matter)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL uchar* matter) {
  for (int n = GROUP; n < NY * NZ; n += GROUPS)
    for (int x = LANE; x < NX; x += LANES) {
      int i = cell_at(P, x, n % NY, n / NY);
      if (is_matter(F[i], A[i])) RAISE(matter[brick_of(P, x, n % NY, n / NY)]);
    }
}
