// Phase `source`: vents, drains, an open border (docs/automaton.md, section 4). One kernel runs for each opening,
// on the cells of its box, in their order.
#define OPENING                                                                                                \
  int x0, int y0, int z0, int size_x, int size_y, int size_z, int at_x, int at_y, int at_z, int radius

#define FOR_REGION                                                                                             \
  for (int n_ = GROUP * LANES + LANE; n_ < size_x * size_y * size_z; n_ += GROUPS * LANES)
#define REGION_CELL                                                                                            \
  int x = x0 + n_ % size_x, y = y0 + n_ / size_x % size_y, z = z0 + n_ / (size_x * size_y);                    \
  long dx_ = 16 * x + 8 - at_x, dy_ = 16 * y + 8 - at_y, dz_ = 16 * z + 8 - at_z;                              \
  if (dx_ * dx_ + dy_ * dy_ + dz_ * dz_ > (long)radius * radius) continue;                                     \
  int i = cell_at(P, x, y, z);

KERNEL(vent)(CONSTANTS, GLOBAL const uchar* F, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H,
             MOMENTS, GLOBAL long* books, OPENING, int rate, int temperature, int energy, int dither, int now) {
  SCRATCH
  long added = 0, added_energy = 0, added_heat = 0, rounded = 0;
  FOR_REGION {
    REGION_CELL
    int before = A[i], more = imin(rate, AMOUNT_MAX - before);
    if (is_blocked(F[i]) || more == 0) continue;
    A[i] = (ushort)(before + more);
    added += more;
    if (PAPER) {
      int e = (more * energy) >> 12;
      E[i] = (ushort)(E[i] + e);
      added_energy += e;
    }
    if (HEAT) {
      uint brought = (uint)more * (uint)temperature;
      added_heat += brought;
      H[i] = (ushort)mix((uint)before * H[i] + brought, (uint)(before + more), dither, &rounded);
    }
    int brick = brick_of(P, x, y, z);
    note(&MATTER_AT(brick), now);
    note(&MOVED_AT(brick), now);
  }
  book(books, scratch, MASS_ADDED, added);
  if (PAPER) book(books, scratch, ENERGY_ADDED, added_energy);
  if (HEAT) {
    book(books, scratch, HEAT_ADDED, added_heat);
    book(books, scratch, HEAT_ROUNDED, rounded);
  }
}

typedef struct {
  long mass, energy, heat;
} Removed;

// Returns what it takes.
FN int drain_cell(CONSTANTS, int i, int rate, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H,
                   PRIVATE Removed* removed) {
  int taken = imin(rate, A[i]), left = A[i] - taken;
  if (taken == 0) return 0;
  removed->mass += taken;
  A[i] = (ushort)left;
  if (PAPER) {
    int lost = imax(0, E[i] - left);
    removed->energy += lost;
    E[i] = (ushort)(E[i] - lost);
  }
  if (HEAT) {
    removed->heat += (long)taken * H[i];
    if (left == 0) H[i] = 0;
  }
  return taken;
}

FN void book_removed(GLOBAL long* books, LOCAL long* scratch, Removed removed) {
  book(books, scratch, MASS_REMOVED, removed.mass);
  book(books, scratch, ENERGY_REMOVED, removed.energy);
  book(books, scratch, HEAT_REMOVED, removed.heat);
}

KERNEL(drain)(CONSTANTS, GLOBAL const uchar* F, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H,
              MOMENTS, GLOBAL long* books, OPENING, int rate, int now) {
  SCRATCH
  Removed removed = {0, 0, 0};
  FOR_REGION {
    REGION_CELL
    if (!is_blocked(F[i]) && drain_cell(P, i, rate, A, E, H, &removed) > 0)
      note(&MOVED_AT(brick_of(P, x, y, z)), now);
  }
  book_removed(books, scratch, removed);
}

KERNEL(border)(CONSTANTS, GLOBAL const uchar* F, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H,
               MOMENTS, GLOBAL long* books, GLOBAL const int* list, GLOBAL const int* counts, int now) {
  SCRATCH
  Removed removed = {0, 0, 0};
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    if (x != 0 && x != NX - 1 && z != 0 && z != NZ - 1) continue;
    if (!is_blocked(F[i]) && drain_cell(P, i, AMOUNT_MAX, A, E, H, &removed) > 0) wake(P, moments, brick, now);
  }
  book_removed(books, scratch, removed);
}
