// Phase `heat` (docs/automaton.md, section 6): conduction, convection, radiation, air, glow.
FN int temperature_of(CONSTANTS, GLOBAL const int* tables, int h, int material) {
  int melting = MELTING_POINT, latent = LATENT_HEAT;
  if (!MATERIALS) return h <= melting ? h : imax(melting, h - latent);
  GLOBAL const int* row = tables + MATERIAL_ROWS + material * MATERIAL_ROW;
  int warm = imin(TOP, (int)(((long)h * row[2]) >> 16));
  return imin(warm, h <= row[0] ? h : imax(row[0], h - row[1]));
}
FN int liquid_from(CONSTANTS, GLOBAL const int* tables, int material) {
  if (!MATERIALS) return MELTING_POINT + LATENT_HEAT;
  GLOBAL const int* row = tables + MATERIAL_ROWS + material * MATERIAL_ROW;
  return row[0] + row[1];
}

// The axes of a pass: 3 to faces, 6 to edges, 4 to corners, as steps in memory.
FN int axis_of(CONSTANTS, int axes, int k) {
  if (axes == 3) return k == 0 ? 1 : k == 1 ? ROW : SLICE;
  if (axes == 6) {
    int one = k < 4 ? 1 : ROW, other = k < 2 ? ROW : SLICE;
    return (k & 1) == 0 ? one + other : one - other;
  }
  return 1 + (k < 2 ? ROW : -ROW) + ((k & 1) == 0 ? SLICE : -SLICE);
}

typedef struct {
  int matter, walls;
} Gain;

// One pass over a set of axes: reads `from`, writes `to`, in all cells of the bricks.
KERNEL(conduct)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                GLOBAL const ushort* from, GLOBAL ushort* to, GLOBAL long* books, GLOBAL const int* list,
                GLOBAL const int* counts, MOMENTS, int axes, int weight, int dither, int now) {
  SCRATCH
  long conducted = 0, from_walls = 0;
  int weights = WEIGHTS + (axes == 3 ? 0 : axes == 6 ? 256 : 512);
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    int h = from[i], a = A[i];
    uint f = F[i];
    if (!is_matter(f, a)) {
      to[i] = (ushort)h;
      continue;
    }
    int material = (int)(f >> MATERIAL_SHIFT), own = temperature_of(P, tables, h, material);
    int gain = 0, wall_gain = 0, differs = 0;
    for (int k = 0; k < axes; ++k) {
      int step = axis_of(P, axes, k), offset = dither_part(dither, k, axes);
      for (int side = 0; side < 2; ++side) {
        int j = side == 0 ? i + step : i - step;
        uint fj = F[j];
        int hj = from[j], wall = WALLS && (fj & INERT) != 0u && hj > 0;
        if (!wall && !is_matter(fj, A[j])) continue;
        int other = (int)(fj >> MATERIAL_SHIFT), there = temperature_of(P, tables, hj, other);
        differs |= there != own;
        int w = MATERIALS ? tables[weights + material * 16 + (wall ? material : other)] : weight;
        int flow = side == 0 ? scaled(there - own, w, offset) : -scaled(own - there, w, offset);
        if (wall)
          wall_gain += flow;
        else
          gain += flow;
      }
    }
    to[i] = (ushort)(h + gain + wall_gain);
    if (differs) note(&WARM_AT(brick), now);
    conducted += (long)gain * a;
    from_walls += (long)wall_gain * a;
  }
  book(books, scratch, HEAT_CONDUCTED, conducted);
  if (WALLS) book(books, scratch, HEAT_WALLS, from_walls);
}

FN int rising(CONSTANTS, GLOBAL const int* tables, int lower, int upper, int dither, PRIVATE int* restless) {
  int below = temperature_of(P, tables, lower, 0), above = temperature_of(P, tables, upper, 0);
  *restless |= below > above;
  return below > above ? scaled(below - above, CONVECTION, dither) : 0;
}

FN int exposed_axes(CONSTANTS, GLOBAL const uchar* F, GLOBAL const ushort* A, int i) {
  return (is_air(F[i + 1], A[i + 1]) || is_air(F[i - 1], A[i - 1])) +
         (is_air(F[i + ROW], A[i + ROW]) || is_air(F[i - ROW], A[i - ROW])) +
         (is_air(F[i + SLICE], A[i + SLICE]) || is_air(F[i - SLICE], A[i - SLICE]));
}
FN int exposed_exchange(int exchange, int axes) { return (exchange * (3 + axes)) >> 2; }
FN int fourth_power(int t) {
  int square = (int)(((long)t * t) >> 16);
  return (int)(((long)square * square) >> 16);
}

// Convection reads `from` and so do all others; `to` may not be `from` where there is convection.
KERNEL(exchange)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ushort* A,
                 GLOBAL const ushort* from, GLOBAL ushort* to, GLOBAL const ushort* irradiance, GLOBAL long* books,
                 GLOBAL const int* list, GLOBAL const int* counts, MOMENTS, int radiates, int dither, int now) {
  SCRATCH
  long convected = 0, radiated = 0, warmed = 0, cooled = 0;
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    int h = from[i], a = A[i];
    uint f = F[i];
    if (is_matter(f, a)) {
      int restless = 0;  // it changes now, or might at another step
      int material = (int)(f >> MATERIAL_SHIFT);
      if (CONVECTION > 0 && !is_blocked(f)) {
        int gain = 0, up = i + ROW, down = i - ROW;
        if (is_liquid(F[down], A[down])) gain += rising(P, tables, from[down], h, dither, &restless);
        if (is_liquid(F[up], A[up])) gain -= rising(P, tables, h, from[up], dither, &restless);
        h += gain;
        convected += (long)gain * a;
      }
      if (radiates && (f & SOLID) != 0u) {
        int gain = imin((irradiance[i] * 4096 + dither) >> 16, HEAT_MAX - h);
        restless |= irradiance[i] > 0;
        h += gain;
        radiated += (long)gain * a;
      }
      int n = AIR ? exposed_axes(P, F, A, i) : 0;
      if (n > 0) {
        int rate = MATERIALS ? tables[MATERIAL_ROWS + material * MATERIAL_ROW + 4] : AIR_EXCHANGE;
        int difference = tables[AIR_TEMPERATURES + y] - temperature_of(P, tables, h, material);
        int gain = imin(scaled(difference, exposed_exchange(rate, n), dither), HEAT_MAX - h);
        restless |= difference != 0;
        h += gain;
        warmed += (long)imax(0, gain) * a;
        cooled += (long)imax(0, -gain) * a;
        if (AIR_GLOW > 0) {
          difference = fourth_power(AIR_SKY) - fourth_power(temperature_of(P, tables, h, material));
          gain = imin(scaled(difference, exposed_exchange(AIR_GLOW, n), dither), HEAT_MAX - h);
          restless |= difference != 0;
          h += gain;
          warmed += (long)imax(0, gain) * a;
          cooled += (long)imax(0, -gain) * a;
        }
      }
      if (restless) note(&WARM_AT(brick), now);
    }
    to[i] = (ushort)h;
  }
  if (CONVECTION > 0) book(books, scratch, HEAT_CONVECTED, convected);
  if (radiates) book(books, scratch, HEAT_RADIATED, radiated);
  if (AIR) {
    book(books, scratch, HEAT_WARMED, warmed);
    book(books, scratch, HEAT_COOLED, cooled);
  }
}

// Puts new words of 64 cells into the irradiance. The cells beyond a row are its border, which nobody reads.
KERNEL(put_light)(CONSTANTS, GLOBAL const int* places, GLOBAL const ushort* words, GLOBAL ushort* irradiance,
                  int count) {
  for (int n = GROUP * LANES + LANE; n < 64 * count; n += GROUPS * LANES) {
    int i = places[n / 64] + n % 64, x = (i - FIRST) % ROW;
    if (x >= n % 64) irradiance[i] = words[n];
  }
}

// Copies the heats of listed bricks, after an even number of passes.
KERNEL(copy_heat)(CONSTANTS, GLOBAL const ushort* from, GLOBAL ushort* to, GLOBAL const int* list,
                  GLOBAL const int* counts) {
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    to[i] = from[i];
  }
}
