// The ground (docs/picture/ground.md, sections 2 to 5 and 8). Its numbers are the host's, as they are few: the heights
// that are drawn, the bare ones, how far bands are bent at the four sides, and the bands.
#define DRAWN_HEIGHTS 0
#define BARE_HEIGHTS (NX * NZ)
#define BENDS_OF_SIDES (2 * NX * NZ)
#define BAND_NOISE (2 * NX * NZ + 2 * NX + 2 * NZ)

#define NO_FACE 0  // the faces through which a ray enters
#define LOW_X 1
#define HIGH_X 2
#define LOW_Z 3
#define HIGH_Z 4
#define UNDER 5
#define UPPER 6

typedef struct {
  int found;
  long part;  // 256ths of a step
  Vec position;
  int face;
} GroundCrossing;

FN int height_at(CONSTANTS, GLOBAL const int* heights, long px, long pz) {
  long cx = cell_below(px), cz = cell_below(pz);
  int left = (int)lclamp(cx, 0, NX - 1), right = (int)lclamp(cx + 1, 0, NX - 1);
  GLOBAL const int* back = heights + lclamp(cz, 0, NZ - 1) * NX;
  GLOBAL const int* front = heights + lclamp(cz + 1, 0, NZ - 1) * NX;
  int w = weight_above(px);
  return blended(blended(back[left], back[right], w), blended(front[left], front[right], w), weight_above(pz));
}
FN long above_ground(CONSTANTS, GLOBAL const int* ground, Vec p) {
  return (p.y >> 8) - height_at(P, ground + DRAWN_HEIGHTS, p.x, p.z);
}
FN int lies_in_ground(CONSTANTS, GLOBAL const int* ground, Vec p) {
  return p.x >= 0 && p.x < ((long)NX << CELL_BITS) && p.z >= 0 && p.z < ((long)NZ << CELL_BITS) && p.y >= 0 &&
         above_ground(P, ground, p) < 0;
}
FN Vec part_at(Ray ray, long part) { return added(ray.start, shifted(by(ray.way, part), 8)); }
FN int face_before(CONSTANTS, Vec p) {
  if (p.x < 0) return LOW_X;
  if (p.x >= ((long)NX << CELL_BITS)) return HIGH_X;
  if (p.z < 0) return LOW_Z;
  if (p.z >= ((long)NZ << CELL_BITS)) return HIGH_Z;
  return p.y < 0 ? UNDER : UPPER;
}
FN GroundCrossing ground_between(CONSTANTS, GLOBAL const int* ground, Ray ray, long outside, long inside) {
  while (inside - outside > 1) {
    long middle = (outside + inside) >> 1;
    if (lies_in_ground(P, ground, part_at(ray, middle)))
      inside = middle;
    else
      outside = middle;
  }
  GroundCrossing met = {1, inside, part_at(ray, inside),
                        inside == 0 ? NO_FACE : face_before(P, part_at(ray, outside))};
  return met;
}

// Samples that cannot reach the ground are left out (section 4).
FN GroundCrossing first_ground(CONSTANTS, VIEW, GLOBAL const int* ground, Ray ray) {
  GroundCrossing none = {0, 0, {0, 0, 0}, NO_FACE};
  if (GROUND_HIGHEST <= 0) return none;
  Ray parts = {by(ray.start, 256), ray.way};
  Samples in = samples_in(parts, vec(0, 0, 0), vec((long)NX << (CELL_BITS + 8), GROUND_HIGHEST << 16, (long)NZ << (CELL_BITS + 8)));
  if (in.first > in.last) return none;
  long nearer = magnitude(ray.way.x) * GROUND_SLOPE_X + magnitude(ray.way.z) * GROUND_SLOPE_Z - ray.way.y * 4096;
  long margin = ((GROUND_SLOPE_X + GROUND_SLOPE_Z) << 13) + (8 << 20);
  for (long part = in.first;;) {
    long above = above_ground(P, ground, part_at(ray, part));
    if (above < 0) {
      long before = part == in.first ? part - 1 : lmax(in.first, ((part - 1) >> 8) * 256);
      return ground_between(P, ground, ray, before, part);
    }
    if (part == in.last) return none;
    long gap = (above << CELL_BITS) - margin;
    long leap = gap <= 0 ? 0 : nearer <= 0 ? (long)1 << 40 : gap / nearer;
    part = lmin(((part >> 8) + leap + 1) * 256, in.last);
  }
}

FN long rim_of(long p, int cells) {
  long behind = lmax(0, 524288 - (((long)cells << CELL_BITS) - p)) >> 7;
  return behind - (lmax(0, 524288 - p) >> 7);
}
FN Vec normal_of_ground(CONSTANTS, PAINT, GLOBAL const int* ground, Vec p, int face) {
  if (face == NO_FACE) return vec(0, 0, 0);
  if (face == LOW_X) return vec(-LENGTH_ONE, 0, 0);
  if (face == HIGH_X) return vec(LENGTH_ONE, 0, 0);
  if (face == LOW_Z) return vec(0, 0, -LENGTH_ONE);
  if (face == HIGH_Z) return vec(0, 0, LENGTH_ONE);
  if (face == UNDER) return vec(0, -LENGTH_ONE, 0);
  GLOBAL const int* bare = ground + BARE_HEIGHTS;
  long half_ = 524288;
  Vec a = vec(height_at(P, bare, p.x - half_, p.z) - height_at(P, bare, p.x + half_, p.z) + rim_of(p.x, NX), 4096,
              height_at(P, bare, p.x, p.z - half_) - height_at(P, bare, p.x, p.z + half_) + rim_of(p.z, NZ));
  return unit(K, shifted(a, imax(0, bits_of(largest(a)) - 14)));
}

// An entry of a row of numbers, blended between two.
FN int entry_of(GLOBAL const int* row, int count, long p) {
  long cell = cell_below(p);
  return blended(row[lclamp(cell, 0, count - 1)], row[lclamp(cell + 1, 0, count - 1)], weight_above(p));
}
FN Vec color_of_cut(CONSTANTS, VIEW, GLOBAL const int* ground, GroundCrossing met) {
  int band = 0;
  if (BANDS > 0 && met.face != UNDER && met.face != NO_FACE) {
    int on_x = met.face == LOW_X || met.face == HIGH_X, count = on_x ? NZ : NX;
    int first = met.face == LOW_X ? 0 : met.face == HIGH_X ? NZ : met.face == LOW_Z ? 2 * NZ : 2 * NZ + NX;
    int bend = entry_of(ground + BENDS_OF_SIDES + first, count, on_x ? met.position.z : met.position.x);
    band = entry_of(ground + BAND_NOISE, BANDS, (met.position.y + bend) << 2);
  }
  return shifted(by(GROUND_COLOR, 2540 + ((41 * band) >> 8)), 12);
}

// A texel has red, green, blue and two bumps of a byte each.
FN int texel_number(GLOBAL const ushort* texels, int channel) {
  if (channel < 3) return texels[channel];
  int bump = (texels[3] >> (channel == 3 ? 0 : 8)) & 255;
  return (bump < 128 ? bump : bump - 256) * 64;
}
FN Vec color_of_top(CONSTANTS, VIEW, PAINT, GLOBAL const ushort* texels, Vec p, PRIVATE Vec* normal) {
  if (!ROCK) return GROUND_COLOR;
  int columns = NX << FINENESS, rows = NZ << FINENESS;
  long px = p.x << FINENESS, pz = p.z << FINENESS, cx = cell_below(px), cz = cell_below(pz);
  int left = (int)lclamp(cx, 0, columns - 1), right = (int)lclamp(cx + 1, 0, columns - 1);
  int back = (int)lclamp(cz, 0, rows - 1) * columns, front = (int)lclamp(cz + 1, 0, rows - 1) * columns;
  int w = weight_above(px), numbers[5];
  for (int c = 0; c < 5; ++c) {
    int behind = blended(texel_number(texels + 4 * (back + left), c), texel_number(texels + 4 * (back + right), c), w);
    int ahead = blended(texel_number(texels + 4 * (front + left), c), texel_number(texels + 4 * (front + right), c), w);
    numbers[c] = blended(behind, ahead, weight_above(pz));
  }
  *normal = unit(K, added(*normal, vec(numbers[3], 0, numbers[4])));
  return vec(numbers[0], numbers[1], numbers[2]);
}
