// Every brick has numbers that say at which moment something happened there last. The host counts moments, one for each
// kernel, so what came after a list was made has a larger one than the list. They tell what sleeps: a brick is left
// out of a phase only if nothing that the phase reads has changed since its list was made before, and if no other
// dither and no other random bits could move anything there.
#define BRICKS (BRICKS_X * BRICKS_Y * BRICKS_Z)
#define MOVED_AT(n) moments[n]                   // a mask, an amount, an energy or what a run shows has changed
#define WARM_AT(n) moments[BRICKS + (n)]         // the phase heat has changed a heat, or may at another step
#define RESTLESS_AT(n) moments[2 * BRICKS + (n)] // some cell may give, whatever the dice said
#define MATTER_AT(n) moments[3 * BRICKS + (n)]   // it held matter
#define SEEN_AT(n) moments[4 * BRICKS + (n)]     // it was looked at, to see whether it holds matter
#define HEATS_AT(n) moments[5 * BRICKS + (n)]    // it was awake for heat
#define FALLS_AT(n) moments[6 * BRICKS + (n)]    // it was awake for gravity
#define SPREADS_AT(n) moments[7 * BRICKS + (n)]  // it was awake for spread
#define WOKEN_AT(n) moments[8 * BRICKS + (n)]    // it has woken those around it
#define LISTED_AT(n) moments[9 * BRICKS + (n)]   // it was put on a list
#define MOMENTS GLOBAL int* moments

FN void note(GLOBAL int* moment, int now) {
  if (LOOK(*moment) != now) STAMP(*moment, now);
}
FN int has_matter(CONSTANTS, MOMENTS, int n) {
  int at = LOOK(MATTER_AT(n));
  return at != 0 && at >= LOOK(SEEN_AT(n));
}

// No kernel writes where it is not listed. The order of a list is any, and no result depends on it.
#define FULL 0     // where the number of entries of each list stands: bricks that hold matter, all or those awake
#define NEAR 1     // bricks that spread looks at
#define COLUMNS 2  // blocks of columns that hold matter
#define GIVING 3   // bricks that give or take in spread
#define COUNTS 4

// Lists are made several times in a step, by turns with one or other counts. Each time sets the other ones to 0.
FN void forget_counts(GLOBAL int* other_counts) {
  if (GROUP == 0 && LANE < COUNTS)
    for (int k = LANE; k < COUNTS; k += LANES) other_counts[k] = 0;
}
FN int is_border_brick(CONSTANTS, int n) {
  int bx = n % BRICKS_X, by = n / BRICKS_X % BRICKS_Y, bz = n / (BRICKS_X * BRICKS_Y);
  return bx == 0 || by == 0 || bz == 0 || bx == BRICKS_X - 1 || by == BRICKS_Y - 1 || bz == BRICKS_Z - 1;
}
FN void list_column(CONSTANTS, MOMENTS, GLOBAL int* columns, GLOBAL int* counts, int n) {
  if (n / BRICKS_X % BRICKS_Y != 1) return;
  int column = 0;
  for (int k = 0; k < BRICKS_Y - 2; ++k) column |= has_matter(P, moments, n + k * BRICKS_X);
  if (column != 0) columns[NEXT(counts + COLUMNS)] = n / (BRICKS_X * BRICKS_Y) * BRICKS_X + n % BRICKS_X;
}

// These tell if a moment of a brick, or of one that it looks at, is later than `since`. In heat a change may go on by
// a cell in each pass, and there are at most four. So it comes no further than the next brick.
FN int late_around(CONSTANTS, GLOBAL const int* own, int since) {
  int late = 0;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) late |= own[(dz * BRICKS_Y + dy) * BRICKS_X + dx] > since;
  return late;
}

// What falls sees its sides, and the cells above and below. What spreads sees its layer, and the cell below.
FN int late_across(CONSTANTS, GLOBAL const int* own, int since) {
  return own[0] > since || own[1] > since || own[-1] > since || own[BRICKS_X] > since || own[-BRICKS_X] > since ||
         own[BRICKS_X * BRICKS_Y] > since || own[-(BRICKS_X * BRICKS_Y)] > since;
}
FN int late_in_layer(CONSTANTS, GLOBAL const int* own, int since) {
  int late = own[-BRICKS_X] > since;
  for (int dz = -1; dz <= 1; ++dz)
    for (int dx = -1; dx <= 1; ++dx) late |= own[dz * BRICKS_X * BRICKS_Y + dx] > since;
  return late;
}

// Lists all bricks that hold matter, and the columns.
KERNEL(list_bricks)(CONSTANTS, MOMENTS, GLOBAL int* full, GLOBAL int* columns, GLOBAL int* counts,
                    GLOBAL int* other_counts) {
  forget_counts(other_counts);
  for (int n = GROUP * LANES + LANE; n < BRICKS; n += GROUPS * LANES) {
    if (is_border_brick(P, n)) continue;
    if (has_matter(P, moments, n)) full[NEXT(counts + FULL)] = n;
    list_column(P, moments, columns, counts, n);
  }
}

// Lists the bricks that are awake for heat and melt, and tells which ones are for gravity. Both are awake beside a
// change. With `all` every brick that holds matter is listed, but only those awake are told.
KERNEL(list_awake)(CONSTANTS, MOMENTS, GLOBAL int* full, GLOBAL int* columns, GLOBAL int* counts,
                   GLOBAL int* other_counts, int since, int all, int now) {
  forget_counts(other_counts);
  for (int n = GROUP * LANES + LANE; n < BRICKS; n += GROUPS * LANES) {
    if (is_border_brick(P, n)) continue;
    list_column(P, moments, columns, counts, n);
    // A cell that was set is looked at even if it holds nothing any more.
    if (!has_matter(P, moments, n) && !(FREEZING_POINT > 0 && MOVED_AT(n) > since)) continue;
    int warm = late_around(P, &MOVED_AT(n), since);
    if (HEAT) warm |= late_around(P, &WARM_AT(n), since);
    if (late_across(P, &MOVED_AT(n), since)) FALLS_AT(n) = now;
    if (warm) HEATS_AT(n) = now;
    if (warm || all) full[NEXT(counts + FULL)] = n;
  }
}

// Lists the bricks in which the paper's law looks for cells that give. A brick that has changed is looked at even if it
// holds nothing any more, as that is seen there.
KERNEL(list_givers)(CONSTANTS, MOMENTS, GLOBAL int* list, GLOBAL int* counts, GLOBAL int* other_counts, int since,
                    int all, int now) {
  forget_counts(other_counts);
  for (int n = GROUP * LANES + LANE; n < BRICKS; n += GROUPS * LANES) {
    if (is_border_brick(P, n)) continue;
    int own = MOVED_AT(n) > since, matter = has_matter(P, moments, n);
    if (!own && !matter) continue;
    int awake = own || RESTLESS_AT(n) > since || (THERMAL && WARM_AT(n) > since) || late_in_layer(P, &MOVED_AT(n), since);
    if (awake) SPREADS_AT(n) = now;
    if (!awake && !all) continue;
    SEEN_AT(n) = now;
    list[NEXT(counts + NEAR)] = n;
  }
}

// These list for the viscous law, in which a step does so several times: the columns in which runs may have changed, the
// bricks in which pairs may exchange something, and who is awake for gravity. Beds of solids change with their heat.
KERNEL(list_columns)(CONSTANTS, MOMENTS, GLOBAL int* columns, GLOBAL int* counts, GLOBAL int* other_counts, int since,
                     int all) {
  forget_counts(other_counts);
  for (int c = GROUP * LANES + LANE; c < BRICKS_X * BRICKS_Z; c += GROUPS * LANES) {
    int bx = c % BRICKS_X, bz = c / BRICKS_X, awake = 0;
    if (bx == 0 || bz == 0 || bx == BRICKS_X - 1 || bz == BRICKS_Z - 1) continue;
    for (int by = 1; by < BRICKS_Y - 1; ++by) {
      int n = (bz * BRICKS_Y + by) * BRICKS_X + bx;
      awake |= MOVED_AT(n) > since || ((all || (HEAT && WARM_AT(n) > since)) && has_matter(P, moments, n));
    }
    if (awake) columns[NEXT(counts + COLUMNS)] = c;
  }
}
KERNEL(list_pairs)(CONSTANTS, MOMENTS, GLOBAL int* full, GLOBAL int* near_, GLOBAL int* counts,
                   GLOBAL int* other_counts, int since, int all, int now) {
  forget_counts(other_counts);
  for (int n = GROUP * LANES + LANE; n < BRICKS; n += GROUPS * LANES) {
    if (is_border_brick(P, n)) continue;
    int own = has_matter(P, moments, n), any = own;
    for (int dz = -1; dz <= 1; ++dz)
      for (int dx = -1; dx <= 1; ++dx) any |= has_matter(P, moments, n + dz * BRICKS_X * BRICKS_Y + dx);
    if (own) full[NEXT(counts + FULL)] = n;
    if (!any) continue;
    int awake = RESTLESS_AT(n) > since || late_around(P, &MOVED_AT(n), since) ||
                (HEAT && late_around(P, &WARM_AT(n), since));
    if (awake) SPREADS_AT(n) = now;
    if (awake || all) near_[NEXT(counts + NEAR)] = n;
  }
}
KERNEL(list_falls)(CONSTANTS, MOMENTS, GLOBAL int* columns, GLOBAL int* counts, GLOBAL int* other_counts, int since,
                   int now) {
  forget_counts(other_counts);
  for (int n = GROUP * LANES + LANE; n < BRICKS; n += GROUPS * LANES) {
    if (is_border_brick(P, n)) continue;
    list_column(P, moments, columns, counts, n);
    if (has_matter(P, moments, n) && late_across(P, &MOVED_AT(n), since)) FALLS_AT(n) = now;
  }
}

// Puts a brick on the list of those that give or take, if it is not there yet.
FN void claim(CONSTANTS, MOMENTS, GLOBAL int* list, GLOBAL int* counts, int n, int now) {
  if (LOOK(LISTED_AT(n)) == now || CLAIM(&LISTED_AT(n), now) == now) return;
  list[NEXT(counts + GIVING)] = n;
}

// Tells that a brick has changed after the list was made that gravity asks. So those around it are woken here.
FN void wake(CONSTANTS, MOMENTS, int n, int now) {
  note(&MOVED_AT(n), now);
  if (LOOK(WOKEN_AT(n)) == now) return;
  STAMP(WOKEN_AT(n), now);
  int plane = BRICKS_X * BRICKS_Y;
  note(&FALLS_AT(n), now);
  for (int side = -1; side <= 1; side += 2) {
    note(&FALLS_AT(n + side), now);
    note(&FALLS_AT(n + side * BRICKS_X), now);
    note(&FALLS_AT(n + side * plane), now);
  }
}

// Finds the bricks that hold matter in a state that has just come.
KERNEL(find_matter)(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, MOMENTS, int now) {
  for (int n = GROUP; n < NY * NZ; n += GROUPS)
    for (int x = LANE; x < NX; x += LANES) {
      int i = cell_at(P, x, n % NY, n / NY);
      if (is_matter(F[i], A[i])) note(&MATTER_AT(brick_of(P, x, n % NY, n / NY)), now);
    }
}
