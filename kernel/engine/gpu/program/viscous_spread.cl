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

// Returns how far two beds differ, or 0 where one of them is none.
FN int bed_rise(int bed, int other) {
  return bed == NO_BED || other == NO_BED ? 0 : imin(31, bed > other ? bed - other : other - bed);
}
FN int slope_factor(int along, int across, int diagonal, int blocked_beside) {
  int square = (along * along + across * across) >> diagonal;
  int root = (1 << 22) / (256 + imin(511, square));
  int factor = (root * root) >> 14;
  return factor + blocked_beside * (factor >> 3);
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

FN int viscous_flow(Shown giver, int a, Shown taker, int b, int diagonal, int dither, int blocked_beside,
                    int across) {
  if (!gives(giver, taker, diagonal)) return 0;
  int drop = imin(giver.column.head - taker.column.head, diagonal ? 724 : HEAD_ONE);
  int slope = slope_factor(bed_rise(giver.column.bed, taker.column.bed), across, diagonal, blocked_beside);
  long product = conductance(giver, a, taker, b, relaxation_of(1)) * ((slope * drop) >> 10), offset = dither;
  int wanted = (int)(diagonal ? (product + (offset << 12)) >> 28 : (product + (offset << 10)) >> 26);
  return imin(wanted, most_flow(a, taker, b, diagonal));
}
FN int relaxed_flow(Shown giver, int a, Shown taker, int b, int diagonal, int dither, int blocked_beside, int across,
                    int fall, Relaxation how) {
  if (!gives(giver, taker, diagonal)) return 0;
  int most = (diagonal ? 724 : HEAD_ONE) * (RELAXED_ONE / HEAD_ONE);
  int own = imin(giver.column.head - taker.column.head, 1024) * (RELAXED_ONE / HEAD_ONE);
  int back = taker.in_run && fall < 0;
  long drop = imin(taker.in_run ? (back ? -fall : fall) : own, most);
  int slope = slope_factor(bed_rise(giver.column.bed, taker.column.bed), across, diagonal, blocked_beside);
  long drive = (2L * slope * drop) >> 16;
  long product = (conductance(giver, a, taker, b, how) * drive) >> (8 + how.bits);
  long offset = ((long)dither << (diagonal ? 5 : 3)) >> how.bits;
  long wanted = (product + offset) >> ((diagonal ? 21 : 19) - how.bits);
  if (back) return -(int)lmin(wanted, most_flow(b, giver, a, diagonal));
  return (int)lmin(wanted, most_flow(a, taker, b, diagonal));
}

// Tells if a pair exchanges something at another dither, the largest. With relaxed heads nobody asks.
FN int may_flow(Shown one, int a, Shown other, int b, int diagonal, int walls, int across, int stages) {
  if (stages > 1) return 0;
  return viscous_flow(one, a, other, b, diagonal, 65535, walls, across) > 0 ||
         viscous_flow(other, b, one, a, diagonal, 65535, walls, across) > 0;
}

FN int blocked_beside(CONSTANTS, GLOBAL const uchar* F, int i, int d) {
  int along = d < 2 ? direction_x(d) : direction_z(d) * SLICE, across = d < 2 ? SLICE : 1;
  return is_blocked(F[i + across]) + is_blocked(F[i - across]) + is_blocked(F[i + along + across]) +
         is_blocked(F[i + along - across]);
}

// Returns how far the bed rises from a cell to another one, below 0 if it falls. It is 0 where one of them is blocked.
FN int rise_between(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                    GLOBAL const ushort* H, GLOBAL const ushort* run, GLOBAL const Column* records, int i, int j, int y) {
  if (is_blocked(F[i]) || is_blocked(F[j])) return 0;
  int from = shown(P, tables, F, A, H, run, records, i, y).column.bed;
  int to = shown(P, tables, F, A, H, run, records, j, y).column.bed;
  return to > from ? bed_rise(from, to) : -bed_rise(from, to);
}
// Returns how steep the beds of an open pair are across it. At the bottom of a valley they are level.
FN int rise_across(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                   GLOBAL const ushort* H, GLOBAL const ushort* run, GLOBAL const Column* records, int i, int d, int y) {
  int dx = direction_x(d), dz = direction_z(d) * SLICE, up = 0, down = 0;
  if (d >= 4) {
    up = rise_between(P, tables, F, A, H, run, records, i + dx, i + dz, y);
    return up < 0 ? -up : up;
  }
  int across = d < 2 ? SLICE : 1;
  for (int k = 0; k < 4; ++k) {
    int from = (k < 2 ? i : i + dx + dz) - (k & 1) * across;
    int rise = rise_between(P, tables, F, A, H, run, records, from, from + across, y);
    up = imax(up, rise);
    down = imax(down, -rise);
  }
  return up > down ? up - down : down - up;
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
                    MOMENTS, GLOBAL long* books, GLOBAL const int* list, GLOBAL int* giving,
                    GLOBAL int* counts, uint step, int substep, int substeps, int stages, int dither, int now) {
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
        int across = rise_across(P, tables, F, A, H, run, records, i, d, y);
        int offset = pair_dither(step, dither_axis(d), y, substep, substeps), wanted;
        if (stages == 1) {
          wanted = viscous_flow(own, a, there, b, diagonal, offset, walls, across) -
                   viscous_flow(there, b, own, a, diagonal, offset, walls, across);
        } else {
          int fall = own.in_run && there.in_run ? heads[i] - heads[j] : 0;
          wanted = relaxed_flow(own, a, there, b, diagonal, offset, walls, across, fall, how) -
                   relaxed_flow(there, b, own, a, diagonal, offset, walls, across, -fall, how);
        }
        int set = FREEZING_POINT > 0 && (T[j] & SET) != 0u, higher = own.column.head > there.column.head;
        if (higher ? own_set : set) continue;
        if (wanted != 0 || may_flow(own, a, there, b, diagonal, walls, across, stages)) note(&RESTLESS_AT(brick), now);
        if (wanted == 0 || (wanted > 0 ? own_set : set)) continue;
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
        note(&MOVED_AT(brick), now);
        claim(P, moments, giving, counts, brick, now);
      }
    }
    new_A[i] = (ushort)a;
    if (HEAT) new_H[i] = (ushort)h;
    note(&SEEN_AT(brick), now);
    if (is_matter(f, a)) note(&MATTER_AT(brick), now);
  }
  if (HEAT) book(books, scratch, HEAT_ROUNDED, rounded);
}
