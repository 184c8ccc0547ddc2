// Phase `spread` of the viscous law (docs/automaton.md, section 11), and the relaxation of heads before it.
#define RELAXED_ONE 32768
#define RELAXED_HEAD_MOST (1 << 24)
#define IMPETUS_MOST ((1 << 20) - 1)

// How heads relax in a sub-step: by so many stages. With one, heads are as they are.
typedef struct {
  int stages, bits, scale;
} Relaxation;
FN Relaxation relaxation_of(int stages) {
  int reach = stages * (stages + 1) / 2, bits = 0;
  while ((1 << bits) < reach) ++bits;
  Relaxation how = {stages, bits, (32768 << bits) / reach};
  return how;
}
FN int time_of(Relaxation how, int j) { return (int)(65536L * (j * j + j) / (how.stages * how.stages + how.stages)); }

TABLE int slope_axis[17] = {16384, 16257, 15888, 15308, 14564, 13707, 12788, 11848, 10923,
                            10034, 9198,  8422,  7710,  7061,  6473,  5941,  5461};
TABLE int slope_diagonal[17] = {16384, 16256, 15876, 15254, 14407, 13365, 12168, 10864, 9511,
                                8165,  6880,  5696,  4641,  3730,  2962,  2331,  1820};
FN int slope_factor(int bed, int other, int diagonal, int blocked_beside) {
  int t = 0;
  if (bed != NO_BED && other != NO_BED) t = imin(16, bed > other ? bed - other : other - bed);
  int across = slope_diagonal[t];
  return diagonal ? across : slope_axis[t] + blocked_beside * (across >> 3);
}

// Is what a cell shows. in_run: its own run's column.
typedef struct {
  Column column;
  int in_run;
} Shown;
FN Shown shown(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
               GLOBAL const ushort* H, GLOBAL const ushort* run, GLOBAL const Column* records, int i, int y) {
  Shown what = {{0, 0, 0, 0, NO_BED, 0, 0, 0}, 0};
  int place = run[i], below = i - ROW;
  if (place != 0) {
    what.column = records[i - (place - 1) * ROW];
    what.in_run = 1;
    return what;
  }
  if (is_blocked(F[below])) {
    what.column.head = bed_head(P, tables, F, A, H, below, y);
    what.column.bed = what.column.head >> 5;
    return what;
  }
  place = run[below];
  if (place != 0) {
    Column top = records[below - (place - 1) * ROW];
    what.column.head = top.head;
    what.column.mobility = top.mobility;
    what.column.bed = top.bed;
    what.column.limit = top.limit;
    return what;
  }
  what.column.head = (y - 2) * HEAD_ONE;
  return what;
}

FN int gives(Shown giver, Shown taker, int diagonal) {
  int dead = diagonal ? (giver.column.dead * 11) >> 3 : giver.column.dead;
  return giver.in_run && giver.column.head - taker.column.head > dead;
}
FN long conductance(Shown giver, int a, Shown taker, int b, Relaxation how) {
  long mobilities = (long)(taker.in_run ? giver.column.mobility : giver.column.exposed) + taker.column.mobility;
  if (taker.column.limit > 0) {
    long most = (long)giver.column.limit << (9 + how.bits);
    if (!taker.in_run && how.stages > 1)
      most = lmax(1, ((long)giver.column.limit * how.scale) >> (14 + how.bits)) << (8 + how.bits);
    mobilities = lmin(mobilities, most);
  }
  int level = giver.column.bed != NO_BED && giver.column.bed == taker.column.bed;
  long flowing = level ? (a + b + 1) >> 1 : a;
  return lmin(((long)1 << (24 + how.bits)) - 1, (mobilities * flowing) >> 12);
}
FN int most_flow(int a, Shown taker, int b, int diagonal) {
  int room = imax(0, (taker.in_run ? AMOUNT_MAX : ONE) - b);
  int most = scaled(imin(a, room), 13107, 0);
  return diagonal ? most >> 2 : most;
}

FN int viscous_flow(Shown giver, int a, Shown taker, int b, int diagonal, int dither, int blocked_beside) {
  if (!gives(giver, taker, diagonal)) return 0;
  int drop = imin(giver.column.head - taker.column.head, diagonal ? 724 : HEAD_ONE);
  int slope = slope_factor(giver.column.bed, taker.column.bed, diagonal, blocked_beside);
  long product = conductance(giver, a, taker, b, relaxation_of(1)) * ((slope * drop) >> 10), offset = dither;
  int wanted = (int)(diagonal ? (product + (offset << 12)) >> 28 : (product + (offset << 10)) >> 26);
  return imin(wanted, most_flow(a, taker, b, diagonal));
}
FN int relaxed_flow(Shown giver, int a, Shown taker, int b, int diagonal, int dither, int blocked_beside, int fall,
                    Relaxation how) {
  if (!gives(giver, taker, diagonal)) return 0;
  int most = (diagonal ? 724 : HEAD_ONE) * (RELAXED_ONE / HEAD_ONE);
  int own = imin(giver.column.head - taker.column.head, 1024) * (RELAXED_ONE / HEAD_ONE);
  int back = taker.in_run && fall < 0;
  long drop = imin(taker.in_run ? (back ? -fall : fall) : own, most);
  int slope = slope_factor(giver.column.bed, taker.column.bed, diagonal, blocked_beside);
  long drive = (2L * slope * drop) >> 16;
  long product = (conductance(giver, a, taker, b, how) * drive) >> (8 + how.bits);
  long offset = ((long)dither << (diagonal ? 5 : 3)) >> how.bits;
  long wanted = (product + offset) >> ((diagonal ? 21 : 19) - how.bits);
  if (back) return -(int)lmin(wanted, most_flow(b, giver, a, diagonal));
  return (int)lmin(wanted, most_flow(a, taker, b, diagonal));
}

FN int blocked_beside(CONSTANTS, GLOBAL const uchar* F, int i, int d) {
  int along = d < 2 ? direction_x(d) : direction_z(d) * SLICE, across = d < 2 ? SLICE : 1;
  return is_blocked(F[i + across]) + is_blocked(F[i - across]) + is_blocked(F[i + along + across]) +
         is_blocked(F[i + along - across]);
}

// The axes of the dither: x, z, and the two diagonals.
FN int dither_axis(int d) { return d < 2 ? 0 : d < 4 ? 1 : d == 4 || d == 7 ? 2 : 3; }
FN int pair_dither(uint step, int axis, int y, int substep, int substeps) {
  int offset = (dither_part(bits_reversed(step), axis, 4) + bits_reversed((uint)y)) & 0xFFFF;
  return (offset + 65536 * ((substep + axis * substeps / 4) % substeps)) / substeps;
}

KERNEL(spread_runs)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                    GLOBAL const ushort* H, GLOBAL ushort* new_A, GLOBAL ushort* new_H, GLOBAL const uchar* T,
                    GLOBAL const ushort* run, GLOBAL const Column* records, GLOBAL const int* heads,
                    GLOBAL uchar* matter, GLOBAL long* books, GLOBAL const int* list, GLOBAL const int* counts,
                    uint step, int substep, int substeps, int stages, int dither) {
  SCRATCH
  long rounded = 0;
  Relaxation how = relaxation_of(stages);
  FOR_LISTED_CELLS(list, counts[NEAR]) {
    CELL
    uint f = F[i];
    int a = A[i], h = HEAT ? H[i] : 0;
    if (!is_blocked(f)) {
      Shown own = shown(P, tables, F, A, H, run, records, i, y);
      int out = 0, in = 0, own_set = FREEZING_POINT > 0 && (T[i] & SET) != 0u;
      uint content = 0;
      for (int d = 0; d < 8; ++d) {
        int j = i + direction_x(d) + direction_z(d) * SLICE;
        if ((!own.in_run && run[j] == 0) || !is_open(P, F, i, d)) continue;
        Shown there = shown(P, tables, F, A, H, run, records, j, y);
        if (own.column.shut && there.column.shut) continue;
        int diagonal = d >= 4, walls = diagonal ? 0 : blocked_beside(P, F, i, d), b = A[j];
        int offset = pair_dither(step, dither_axis(d), y, substep, substeps), wanted;
        if (stages == 1) {
          wanted = viscous_flow(own, a, there, b, diagonal, offset, walls) -
                   viscous_flow(there, b, own, a, diagonal, offset, walls);
        } else {
          int fall = own.in_run && there.in_run ? heads[i] - heads[j] : 0;
          wanted = relaxed_flow(own, a, there, b, diagonal, offset, walls, fall, how) -
                   relaxed_flow(there, b, own, a, diagonal, offset, walls, -fall, how);
        }
        if (wanted == 0) continue;
        int set = FREEZING_POINT > 0 && (T[j] & SET) != 0u, higher = own.column.head > there.column.head;
        if ((higher ? own_set : set) || (wanted > 0 ? own_set : set)) continue;
        if (wanted > 0) {
          out += wanted;
        } else {
          in -= wanted;
          if (HEAT) content += (uint)-wanted * H[j];
        }
      }
      if (out != 0 || in != 0) {
        if (HEAT && in > 0) h = mix(content + (uint)(a - out) * (uint)h, (uint)(a - out + in), dither, &rounded);
        a += in - out;
        if (a == 0) h = 0;
      }
    }
    new_A[i] = (ushort)a;
    if (HEAT) new_H[i] = (ushort)h;
    if (is_matter(f, a) && !LOOK(matter[brick])) RAISE(matter[brick]);
  }
  if (HEAT) book(books, scratch, HEAT_ROUNDED, rounded);
}
