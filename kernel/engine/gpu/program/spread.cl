// Phase `spread` of the paper's law (docs/automaton.md, section 9).
FN int flow_cap(CONSTANTS) { return NEIGHBOURS == 8 ? ONE : 2 * ONE; }
FN int thermal_share(CONSTANTS, GLOBAL const int* tables, int h) {
  if (!THERMAL) return SHARE;
  return imin((SHARE * tables[MOBILITY_TABLE + (h >> 11)]) >> 15, NEIGHBOURS == 8 ? 13107 : 16384);
}
FN int shared_part(CONSTANTS, int a, int share, int diagonal) {
  int f = imin(scaled(a, share, 0), flow_cap(P));
  return diagonal ? f >> 2 : f;
}
FN uint random_byte(CONSTANTS, GLOBAL const int* tables, int x, int y, int z, uint step) {
  uint X = step, Y = ((uint)z * (uint)NY + (uint)y) * (uint)((NX + 7) / 8) + (uint)(x / 8);
  for (int round = 0; round < 10; ++round) {
    X = (((X >> 8) | (X << 24)) + Y) ^ (uint)tables[KEYS + round];
    Y = ((Y << 3) | (Y >> 29)) ^ X;
  }
  return (((x & 4) != 0 ? X : Y) >> (8 * (x & 3))) & 255u;
}
FN int is_open(CONSTANTS, GLOBAL const uchar* F, int i, int d) {
  int dx = direction_x(d), dz = direction_z(d) * SLICE;
  if (is_blocked(F[i + dx + dz])) return 0;
  return d < 4 || !(is_blocked(F[i + dx]) && is_blocked(F[i + dz]));
}

// Finds the directions that each liquid cell gives to, and lists the bricks that give or take. Where it does not look,
// all patterns are 0: a brick with another one is restless. It also sees which bricks hold matter.
KERNEL(find_patterns)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                      GLOBAL const ushort* E, GLOBAL const ushort* H, GLOBAL uchar* T, GLOBAL uchar* pattern,
                      MOMENTS, GLOBAL const int* list, GLOBAL int* giving, GLOBAL int* counts, uint step, int now) {
  FOR_LISTED_CELLS(list, counts[NEAR]) {
    CELL
    int a = A[i];
    uint bits = 0;
    int margin = -1;
    if (is_matter(F[i], a)) note(&MATTER_AT(brick), now);
    if (HAS_TRANSIENTS && T[i] != 0 && T[i] != SET) T[i] = 0;
    if (is_liquid(F[i], a) && !(SUPPORT && is_air(F[i - ROW], A[i - ROW])) &&
        !(FREEZING_POINT > 0 && (T[i] & SET) != 0u)) {
      if (E[i] > THRESHOLD)
        margin = MARGIN;
      else if (SLUMP > 0)
        margin = SLUMP;
    }
    if (margin >= 0) {
      int share = thermal_share(P, tables, HEAT ? H[i] : 0);
      int flow = USE_TABLE ? 0 : shared_part(P, a, share, 0);
      for (int d = 0; d < NEIGHBOURS; ++d) {
        int b = A[i + direction_x(d) + direction_z(d) * SLICE];
        if (!is_open(P, F, i, d) || b >= (NEIGHBOURS == 8 ? 11 : 8) * ONE) continue;
        if (DOWNHILL && b + imax(flow, d >= 4 ? (9 * margin) >> 3 : margin) >= a) continue;
        bits |= 1u << d;
      }
      if (bits != 0u) {
        note(&RESTLESS_AT(brick), now);
        bits &= random_byte(P, tables, x, y, z, step);
      }
    }
    if (bits != 0u) claim(P, moments, giving, counts, brick, now);
    for (int d = 0; d < NEIGHBOURS; ++d)
      if (((bits >> d) & 1u) != 0u)
        claim(P, moments, giving, counts, brick_of(P, x + direction_x(d), y, z + direction_z(d)), now);
    pattern[i] = (uchar)bits;
  }
}

FN int contact_alpha(CONSTANTS, GLOBAL const uchar* F, int i) {
  uint below = F[i - ROW];
  return (below & INERT) != 0u ? ALPHA_FLOOR : (below & SOLID) != 0u ? ALPHA_SOLID : ALPHA_LIQUID;
}

typedef struct {
  int amount, energy;
} Gift;

// Returns what cell i gives in direction d of its pattern.
FN Gift given(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, int i, int a, int e, int h, uint bits, int d) {
  Gift gift = {0, 0};
  int share = USE_TABLE ? tables[PATTERN_TABLE + (int)bits * 4 + d] : thermal_share(P, tables, h);
  gift.amount = shared_part(P, a, share, d >= 4);
  gift.energy = imin(gift.amount, shared_part(P, e, share, d >= 4));
  if (PRINTED) gift.energy = scaled(gift.energy, contact_alpha(P, F, i), 0);
  return gift;
}

// Every cell loses its gifts and takes those of its neighbours. All cells of the bricks that give or take are written,
// and take_over brings them back.
KERNEL(apply_patterns)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                       GLOBAL const ushort* E, GLOBAL const ushort* H, GLOBAL ushort* new_A, GLOBAL ushort* new_E,
                       GLOBAL ushort* new_H, GLOBAL const uchar* pattern, MOMENTS, GLOBAL long* books,
                       GLOBAL const int* giving, GLOBAL const int* counts, int dither, int now) {
  SCRATCH
  long dissipated = 0, capped = 0, rounded = 0;
  FOR_LISTED_CELLS(giving, counts[GIVING]) {
    CELL
    uint f = F[i];
    int a = A[i], e = E[i], h = HEAT ? H[i] : 0;
    if (!is_blocked(f)) {
      uint bits = pattern[i], content = 0;
      Gift out = {0, 0}, in = {0, 0};
      for (int d = 0; d < NEIGHBOURS; ++d) {
        if (((bits >> d) & 1u) != 0u) {
          Gift mine = given(P, tables, F, i, a, e, h, bits, d);
          out.amount += mine.amount;
          out.energy += mine.energy;
        }
        int j = i + direction_x(d) + direction_z(d) * SLICE;
        if (((pattern[j] >> opposite(d)) & 1) == 0) continue;
        int g = HEAT ? H[j] : 0;
        Gift theirs = given(P, tables, F, j, A[j], E[j], g, pattern[j], opposite(d));
        in.amount += theirs.amount;
        in.energy += theirs.energy;
        content += (uint)theirs.amount * (uint)g;
      }
      if (out.amount != 0 || in.amount != 0) {
        int gained = PRINTED ? in.energy : scaled(in.energy, contact_alpha(P, F, i), dither);
        int amount = a - out.amount + in.amount, energy = e - out.energy + gained;
        dissipated += in.energy - gained;
        capped += imax(0, energy - amount);
        if (HEAT && in.amount > 0)
          h = mix(content + (uint)(a - out.amount) * (uint)h, (uint)amount, dither, &rounded);
        a = amount;
        e = imin(energy, amount);
        if (a == 0) h = 0;
        note(&MOVED_AT(brick), now);
        if (a > 0) note(&MATTER_AT(brick), now);
      }
    }
    new_A[i] = (ushort)a;
    new_E[i] = (ushort)e;
    if (HEAT) new_H[i] = (ushort)h;
  }
  book(books, scratch, ENERGY_DISSIPATED, dissipated);
  book(books, scratch, ENERGY_CAPPED, capped);
  if (HEAT) book(books, scratch, HEAT_ROUNDED, rounded);
}

// Brings what spread has written back to where the state is. So the state is in one place always, and bricks that
// sleep need no copy.
KERNEL(take_over)(CONSTANTS, GLOBAL ushort* A, GLOBAL ushort* E, GLOBAL ushort* H, GLOBAL const ushort* new_A,
                  GLOBAL const ushort* new_E, GLOBAL const ushort* new_H, GLOBAL const int* giving,
                  GLOBAL const int* counts) {
  FOR_LISTED_CELLS(giving, counts[GIVING]) {
    CELL
    A[i] = new_A[i];
    if (PAPER) E[i] = new_E[i];
    if (HEAT) H[i] = new_H[i];
  }
}
