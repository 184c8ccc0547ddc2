// Phase `gravity` (docs/automaton.md, section 8): one item sweeps one column upwards, in place.

// A cell on its way: the lower or the upper one of a pair.
typedef struct {
  int i, a, e, h, blocked, changed;
} Held;

// Is a blocked side. Under the paper's law the sides date from before melt.
FN int is_side(CONSTANTS, GLOBAL const uchar* F, GLOBAL const uchar* T, int j) {
  if (!PAPER || !HEAT) return is_blocked(F[j]);
  uint t = T[j];
  return (is_blocked(F[j]) && (t & FROZEN) == 0u) || (t & MELTED) != 0u;
}

// Returns what the upper cell of a pair is ready to give. `a` is its amount, `lower` that of the cell below.
FN int ready_to_fall(CONSTANTS, GLOBAL const uchar* F, GLOBAL const uchar* T, int j, int a, int lower) {
  uint factor = (uint)FACTOR;
  if (SEES_SIDES) {
    int wall = is_side(P, F, T, j - 1) || is_side(P, F, T, j + 1) || is_side(P, F, T, j - SLICE) ||
               is_side(P, F, T, j + SLICE);
    int touches = wall || is_blocked(F[j + ROW]);
    if (touches && FREEZING_POINT > 0 && (T[j] & SET) != 0u) return 0;
    if (touches && lower == 0 && a < HANG) return 0;
    if (wall) factor = (uint)WALL_FACTOR;
  }
  return imin(a, (int)(((ulong)a * factor) >> 16) + MINIMUM);
}

typedef struct {
  long accelerated, capped, rounded;
} FallBooks;

FN void transfer(CONSTANTS, PRIVATE Held* from, PRIVATE Held* to, int flow, int dither, PRIVATE FallBooks* sums) {
  if (HEAT)
    to->h = mix((uint)to->a * (uint)to->h + (uint)flow * (uint)from->h, (uint)(to->a + flow), dither, &sums->rounded);
  from->a -= flow;
  to->a += flow;
  from->changed = to->changed = 1;
}

FN void let_fall(CONSTANTS, PRIVATE Held* low, PRIVATE Held* high, int flow, int dither, PRIVATE FallBooks* sums) {
  if (PAPER) {
    int moved = imin(high->e, flow), room = low->a + flow - low->e;
    int faster = (int)(((ulong)moved * (uint)BETA) >> 16);
    int lost = moved, gained = imin(faster, room);
    if (PRINTED) lost = gained = imin(gained, high->e);
    high->e -= lost;
    low->e += gained;
    sums->accelerated += gained - lost;
  }
  transfer(P, high, low, flow, dither, sums);
  if (PAPER && high->e > high->a) {
    sums->capped += high->e - high->a;
    high->e = high->a;
  }
}

FN void push_up(CONSTANTS, PRIVATE Held* low, PRIVATE Held* high, int flow, int dither, PRIVATE FallBooks* sums) {
  int energy = imin(low->e, flow);
  low->e -= energy;
  high->e += energy;
  transfer(P, low, high, flow, dither, sums);
}

FN Held held(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, GLOBAL const ushort* E,
             GLOBAL const ushort* H, int i) {
  Held cell = {0, 0, 0, 0, 0, 0};
  cell.i = i;
  cell.a = A[i];
  cell.blocked = is_blocked(F[i]);
  if (PAPER) cell.e = E[i];
  if (HEAT) cell.h = H[i];
  return cell;
}

FN void put_back(CONSTANTS, Held cell, int brick, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H,
                 MOMENTS, int now) {
  if (!cell.changed) return;
  note(&MOVED_AT(brick), now);
  A[cell.i] = (ushort)cell.a;
  if (PAPER) E[cell.i] = (ushort)(cell.a > 0 ? cell.e : 0);
  if (HEAT) H[cell.i] = (ushort)(cell.a > 0 ? cell.h : 0);
  if (cell.a > 0) note(&MATTER_AT(brick), now);
}

FN int is_falling(CONSTANTS, MOMENTS, int n, int awake_since) {
  return has_matter(P, moments, n) && LOOK(FALLS_AT(n)) >= awake_since;
}

// `run` says which cells are in a run of the viscous law; those do not fall.
KERNEL(gravity)(CONSTANTS, GLOBAL const uchar* F, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H,
                GLOBAL const uchar* T, GLOBAL const ushort* run, GLOBAL long* books, MOMENTS,
                GLOBAL const int* columns, GLOBAL const int* counts, int dither, int awake_since, int now) {
  SCRATCH
  FallBooks sums = {0, 0, 0};
  FOR_LISTED_COLUMNS(columns, counts[COLUMNS]) {
    COLUMN
    int bottom = cell_at(P, x, 0, z), brick = brick_of(P, x, 0, z), y = 0;
    Held low = held(P, F, A, E, H, bottom), high = held(P, F, A, E, H, bottom + ROW);
    while (y + 1 < NY) {
      int by = (y + 1) / BRICK_Y;
      // Nothing moves in a brick that sleeps or holds no matter, if none climbs into it and none has left the cell
      // below it. Its uppermost cell is looked at next.
      if ((y == 0 || (y + 1) % BRICK_Y == 0) && low.a <= ONE && !low.changed &&
          !is_falling(P, moments, brick + by * BRICKS_X, awake_since)) {
        put_back(P, low, brick + y / BRICK_Y * BRICKS_X, A, E, H, moments, now);
        y = imin(by * BRICK_Y + BRICK_Y - 1, NY - 1);
        low = held(P, F, A, E, H, bottom + y * ROW);
        high = held(P, F, A, E, H, low.i + ROW);
        continue;
      }
      Held next = held(P, F, A, E, H, high.i + ROW);  // before its turn, as it takes long to come
      if (low.a + high.a > 0 && !low.blocked && !high.blocked) {
        if (high.a > 0 && low.a < ONE && (PAPER || run[high.i] == 0)) {
          int flow = imin(ready_to_fall(P, F, T, high.i, high.a, low.a), ONE - low.a);
          if (flow > 0) let_fall(P, &low, &high, flow, dither, &sums);
        } else if (PAPER && low.a > ONE) {
          int flow = imin(low.a - ONE, AMOUNT_MAX - high.a);
          if (flow > 0) push_up(P, &low, &high, flow, dither, &sums);
        }
      }
      put_back(P, low, brick + y / BRICK_Y * BRICKS_X, A, E, H, moments, now);
      low = high;
      high = next;
      ++y;
    }
    put_back(P, low, brick + y / BRICK_Y * BRICKS_X, A, E, H, moments, now);
  }
  if (PAPER) {
    book(books, scratch, ENERGY_ACCELERATED, sums.accelerated);
    book(books, scratch, ENERGY_CAPPED, sums.capped);
  }
  if (HEAT) book(books, scratch, HEAT_ROUNDED, sums.rounded);
}
