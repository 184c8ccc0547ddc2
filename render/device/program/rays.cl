// Rays, samples and crossings with matter (docs/picture/definition.md, sections 4 to 8).
typedef struct {
  Vec start, way;  // sample k lies at start + k way
} Ray;
typedef struct {
  long first, last;
} Samples;
typedef struct {
  int found;
  long sample;
  int part;
  Vec position;
} Crossing;

FN Vec ray_at(Ray ray, long k) { return added(ray.start, by(ray.way, k)); }

FN Ray ray_through(VIEW, int across, int down) {
  long u = across - HALF_WIDTH, v = HALF_HEIGHT - down;
  Vec direction = added(added(by(FORWARD, HALF_HEIGHT), by(VIEW_WIDE, u)), by(VIEW_HIGH, v));
  Vec on_plane = shifted(added(by(NEAR_WIDE, u), by(NEAR_HIGH, v)), 10);
  int shift = bits_of(largest(direction) - 1) - (CELL_BITS - SPACING);
  Ray ray = {added(added(EYE, shifted(by(FORWARD, VIEW_NEAR), 14)), on_plane),
             vec(rounded_to(direction.x, shift), rounded_to(direction.y, shift), rounded_to(direction.z, shift))};
  return ray;
}

FN Samples samples_along(Samples in, long start, long way, long low, long high) {
  long before = low - start, behind = high - 1 - start;
  if (way == 0) {
    if (before > 0 || behind < 0) in.last = -1;
  } else if (way > 0) {
    in.first = lmax(in.first, ceil_divided(before, way));
    in.last = lmin(in.last, floor_divided(behind, way));
  } else {
    in.first = lmax(in.first, ceil_divided(-behind, -way));
    in.last = lmin(in.last, floor_divided(-before, -way));
  }
  return in;
}
// The samples with low <= position < high. `first` is never below 0, so -1 as `last` means that there is none.
FN Samples samples_in(Ray ray, Vec low, Vec high) {
  Samples in = {0, 9223372036854775807L};
  in = samples_along(in, ray.start.x, ray.way.x, low.x, high.x);
  in = samples_along(in, ray.start.y, ray.way.y, low.y, high.y);
  return samples_along(in, ray.start.z, ray.way.z, low.z, high.z);
}

FN int sample_of(CONSTANTS, GLOBAL const short* levels, Vec p) {
  int x = (int)cell_below(p.x), y = (int)cell_below(p.y), z = (int)cell_below(p.z), wx = weight_above(p.x);
  GLOBAL const short* a = levels + place_at(P, x, y, z);
  GLOBAL const short* b = a + WIDE * HIGH;
  int wy = weight_above(p.y);
  int low = blended(blended(a[0], a[1], wx), blended(a[WIDE], a[WIDE + 1], wx), wy);
  int high = blended(blended(b[0], b[1], wx), blended(b[WIDE], b[WIDE + 1], wx), wy);
  return blended(low, high, weight_above(p.z));
}

// Sample k is matter, at `inside`.
FN Crossing crossing_between(CONSTANTS, GLOBAL const short* levels, Vec outside, Vec inside, long k) {
  int low = sample_of(P, levels, outside), high = sample_of(P, levels, inside), part = 0;
  for (int i = 0; i < 3; ++i) {
    Vec middle = added(outside, shifted(without(inside, outside), 1));
    int level = sample_of(P, levels, middle);
    part *= 2;
    if (level < 0) {
      outside = middle;
      low = level;
      ++part;
    } else {
      inside = middle;
      high = level;
    }
  }
  int last = -low * 256 / (high - low);
  Crossing met = {1, k, part * 256 + last, added(outside, shifted(by(without(inside, outside), last), 8))};
  return met;
}

// In a block of air so many samples further are air, too: no step is longer than 2^-SPACING cells along an axis.
FN Crossing first_crossing(CONSTANTS, VIEW, GLOBAL const short* levels, GLOBAL const uchar* blocks, Ray ray,
                           long from) {
  long low = -((long)1 << CELL_BITS) - TO_PLACE;
  Vec high = vec(((long)NX << CELL_BITS) - TO_PLACE, ((long)NY << CELL_BITS) - TO_PLACE, ((long)NZ << CELL_BITS) - TO_PLACE);
  Samples in = samples_in(ray, vec(low, low, low), high);
  for (long k = lmax(in.first, from); k <= in.last; ++k) {
    Vec p = ray_at(ray, k);
    int bx = (int)(cell_below(p.x) + 1) >> 2, by_ = (int)(cell_below(p.y) + 1) >> 2, bz = (int)(cell_below(p.z) + 1) >> 2;
    int air = blocks[(bz * BLOCKS_Y + by_) * BLOCKS_X + bx];
    if (air > 0) {
      k += (long)(4 * (air - 1)) << SPACING;
      continue;
    }
    if (sample_of(P, levels, p) < 0) continue;
    if (k > 0) return crossing_between(P, levels, ray_at(ray, k - 1), p, k);
    Crossing at_start = {1, 0, 2048, ray.start};
    return at_start;
  }
  Crossing none = {0, 0, 0, {0, 0, 0}};
  return none;
}

FN int splined(int a, int b, int c, int p, int q, int r, int bits) {
  return (a * p + b * q + c * r + (1 << (bits - 1))) >> bits;
}
// The weights of a cell and its neighbours at a position (section 8).
typedef struct {
  int cell, low, middle, high, slope_low, slope_middle, slope_high;
} Spline;
FN Spline spline_of(long p) {
  long at = p + 2048;
  int u = (int)(at >> 12) & 255, t = 256 - u, l = (t * t) >> 9, r = (u * u) >> 9;
  Spline spline = {(int)(at >> CELL_BITS), l, 256 - l - r, r, -t, t - u, u};
  return spline;
}
FN int value_by(Spline s, PRIVATE const int* n) { return splined(n[0], n[1], n[2], s.low, s.middle, s.high, 8); }
FN int slope_by(Spline s, PRIVATE const int* n) {
  return splined(n[0], n[1], n[2], s.slope_low, s.slope_middle, s.slope_high, 9);
}
FN Vec normal_at(CONSTANTS, PAINT, GLOBAL const short* levels, Vec p) {
  Spline x = spline_of(p.x), y = spline_of(p.y), z = spline_of(p.z);
  int slope_x[3], slope_y[3], value[3];
  for (int k = 0; k < 3; ++k) {
    int slopes[3], values[3];
    for (int j = 0; j < 3; ++j) {
      GLOBAL const short* row = levels + place_at(P, x.cell - 1, y.cell + j - 1, z.cell + k - 1);
      int three[3] = {row[0], row[1], row[2]};
      slopes[j] = slope_by(x, three);
      values[j] = value_by(x, three);
    }
    slope_x[k] = value_by(y, slopes);
    slope_y[k] = slope_by(y, values);
    value[k] = value_by(y, values);
  }
  return unit(K, vec(-value_by(z, slope_x), -value_by(z, slope_y), -slope_by(z, value)));
}
