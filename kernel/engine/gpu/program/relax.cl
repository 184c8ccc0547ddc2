// Heads relax before the viscous law's spread (docs/automaton.md, section 11, "Relaxed heads").

// Returns what the pair i, j levels in one stage if i gives.
FN int leveling_of(Shown giver, int a, Shown taker, int b, int diagonal, int walls, int across, Relaxation how) {
  if (!gives(giver, taker, diagonal)) return 0;
  long coarse = ((conductance(giver, a, taker, b, how) >> (8 + how.bits)) *
                 slope_factor(bed_rise(giver.column.bed, taker.column.bed), across, diagonal, walls)) >> 16;
  long cells = imin(giver.column.cells, taker.column.cells);
  return (int)lmin(65535, cells * ((coarse * how.scale) >> (diagonal ? 16 : 14)));
}

FN int integrated(CONSTANTS, int head, int y, int change, int stage, Relaxation how) {
  int own = imin(RELAXED_HEAD_MOST, head - (y - 2) * HEAD_ONE);
  return (int)(((long)own * time_of(how, stage)) >> 10) + change;
}

// Finds how much each cell in a run levels with its neighbours, and its head after the first stage. `leveling` has
// a slice of CELLS numbers for each direction.
KERNEL(begin_relaxing)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                       GLOBAL const ushort* H, GLOBAL const uchar* T, GLOBAL const ushort* run,
                       GLOBAL const Column* records, GLOBAL ushort* leveling, GLOBAL int* heads, GLOBAL int* impetus,
                       GLOBAL int* change, GLOBAL const int* list, GLOBAL const int* counts, int stages) {
  Relaxation how = relaxation_of(stages);
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    if (run[i] == 0) continue;
    Shown own = shown(P, tables, F, A, H, run, records, i, y);
    int a = A[i], own_set = FREEZING_POINT > 0 && (T[i] & SET) != 0u;
    for (int d = 0; d < 8; ++d) {
      int j = i + direction_x(d) + direction_z(d) * SLICE, level = 0;
      if (run[j] != 0 && is_open(P, F, i, d)) {
        Shown there = shown(P, tables, F, A, H, run, records, j, y);
        int diagonal = d >= 4, walls = diagonal ? 0 : blocked_beside(P, F, i, d), b = A[j];
        int set = FREEZING_POINT > 0 && (T[j] & SET) != 0u;
        if (!(own.column.shut && there.column.shut)) {
          int across = rise_across(P, tables, F, A, H, run, records, i, d, y);
          if (!own_set) level += leveling_of(own, a, there, b, diagonal, walls, across, how);
          if (!set) level += leveling_of(there, b, own, a, diagonal, walls, across, how);
        }
      }
      leveling[(long)d * CELLS + i] = (ushort)level;
    }
    impetus[i] = change[i] = 0;
    heads[i] = integrated(P, own.column.head, y, 0, 1, how);
  }
}

// Computes the heads after stage + 1 from those after `stage`.
KERNEL(relax)(CONSTANTS, GLOBAL const ushort* run, GLOBAL const Column* records, GLOBAL const ushort* leveling,
              GLOBAL const int* heads, GLOBAL int* new_heads, GLOBAL int* impetus, GLOBAL int* change,
              GLOBAL const int* list, GLOBAL const int* counts, int stages, int stage) {
  Relaxation how = relaxation_of(stages);
  int counted = time_of(how, stage) >> 1, next = stage + 1;
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    if (run[i] == 0) continue;
    int own = heads[i], taken = 0, given = 0;
    for (int d = 0; d < 8; ++d) {
      int level = leveling[(long)d * CELLS + i];
      if (level == 0) continue;
      int rise = heads[i + direction_x(d) + direction_z(d) * SLICE] - own;
      int part = (int)(((long)level * imin(counted, rise < 0 ? -rise : rise)) >> 16);
      if (rise > 0)
        taken += part;
      else
        given += part;
    }
    int gain = imin(65535, taken) - imin(65535, given);
    int push = iclamp(impetus[i] + (2 * next - 1) * gain, -IMPETUS_MOST, IMPETUS_MOST);
    impetus[i] = push;
    // The shift rounds down, whatever the sign.
    change[i] += (push * ((4096 + next / 2) / next)) >> 12;
    new_heads[i] = integrated(P, records[i - (run[i] - 1) * ROW].head, y, change[i], next, how);
  }
}
