// Light at a surface, and its colour (docs/picture/light.md, sections 5 and 6).
typedef struct {
  int lamp, open[6], glow[6];
} Light;

// Bytes of a cell of light, blended between eight. Those beyond the grid repeat the nearest.
FN int light_byte(VIEW, GLOBAL const uchar* light, PRIVATE const int* at, PRIVATE const int* w, int byte_) {
  int low = blended(blended(light[at[0] + byte_], light[at[1] + byte_], w[0]),
                    blended(light[at[2] + byte_], light[at[3] + byte_], w[0]), w[1]);
  int high = blended(blended(light[at[4] + byte_], light[at[5] + byte_], w[0]),
                     blended(light[at[6] + byte_], light[at[7] + byte_], w[0]), w[1]);
  return blended(low, high, w[2]);
}
FN Light light_at(VIEW, PAINT, GLOBAL const uchar* light, Vec position) {
  Vec p = shifted(position, LIGHT_SHIFT);
  int w[3] = {weight_above(p.x), weight_above(p.y), weight_above(p.z)}, at[8];
  long x = cell_below(p.x), y = cell_below(p.y), z = cell_below(p.z);
  for (int n = 0; n < 8; ++n) {
    int cx = (int)lclamp(x + (n & 1), 0, LIGHT_X - 1), cy = (int)lclamp(y + ((n >> 1) & 1), 0, LIGHT_Y - 1);
    int cz = (int)lclamp(z + (n >> 2), 0, LIGHT_Z - 1);
    at[n] = ((cz * LIGHT_Y + cy) * LIGHT_X + cx) * LIGHT_BYTES;
  }
  Light found;
  found.lamp = light_byte(V, light, at, w, 0);
  for (int side = 0; side < SIDES; ++side) {
    found.open[side] = light_byte(V, light, at, w, OPEN_BYTES + side);
    found.glow[side] = GLOWS ? light_byte(V, light, at, w, GLOW_BYTES + side) : 0;
  }
  return found;
}
FN Light light_before(VIEW, PAINT, GLOBAL const uchar* light, Vec position, Vec normal) {
  return light_at(V, K, light, added(position, by(normal, (long)1 << (6 + LIGHT_SHIFT))));
}
FN int seen_along(PRIVATE const int* sides, Vec d) {
  long sum = ((d.x * d.x) >> LENGTH_BITS) * sides[d.x < 0 ? 1 : 0] + ((d.y * d.y) >> LENGTH_BITS) * sides[d.y < 0 ? 3 : 2] +
             ((d.z * d.z) >> LENGTH_BITS) * sides[d.z < 0 ? 5 : 4];
  return (int)lmin(sum >> LENGTH_BITS, 255);
}
FN int whole_of(int byte_) { return byte_ + (byte_ >> 7); }
FN int cosine_of(Vec a, Vec b) { return (int)(dot_of(a, b) >> LENGTH_BITS); }
FN int times_of(int a, int b) { return (int)rounded_to((long)a * b, 12); }
FN int mixed_by(int a, int b, int share) { return a + times_of(b - a, share); }
FN int smooth_light(int low, int high, int at) {
  long t = lclamp(floor_divided((long)(at - low) * LIGHT_ONE, high - low), 0, LIGHT_ONE);
  return (int)((t * t * (3 * LIGHT_ONE - 2 * t)) >> 24);
}

TABLE int GLOW_LIGHT[3] = {6144, 1966, 369};
TABLE int MIRRORED_LAMP[3] = {9830, 9626, 9216};
TABLE int MIRRORED_STRIP[3] = {2867, 3072, 3482};

FN Color arriving_light(PAINT, Vec normal, PRIVATE const Light* light, int lit_by_glow) {
  int facing = cosine_of(normal, TO_LIGHT);
  int lit = (((imax(facing + 2458, 0) * 14247) >> LENGTH_BITS) * whole_of(light->lamp)) >> 8;
  int open = whole_of(seen_along(light->open, normal)), glow = lit_by_glow ? seen_along(light->glow, normal) : 0;
  int up = (int)normal.y + LENGTH_ONE;
  Color sum;
  for (int c = 0; c < 3; ++c) {
    int ambient = K[FROM_BELOW + c] + (((K[FROM_ABOVE + c] - K[FROM_BELOW + c]) * up) >> (LENGTH_BITS + 1));
    sum.c[c] = ((ambient * open) >> 8) + ((K[LAMP + c] * lit) >> LENGTH_BITS) + ((GLOW_LIGHT[c] * glow) >> 5);
  }
  return sum;
}

FN Color mirrored_light(PAINT, Vec r) {
  int height = (int)lclamp(r.y + LENGTH_ONE, 0, 2 * LENGTH_ONE);
  uint packed = (uint)K[SURROUNDINGS + (height >> 4)];
  int around[3] = {(int)(packed & 2047u) << 1, (int)((packed >> 11) & 2047u) << 1, (int)(packed >> 22) << 2};
  int lamp = smooth_light(LAMP_MIRROR_LOW, LAMP_MIRROR_HIGH, cosine_of(r, TO_LIGHT) >> 2);
  int strip = smooth_light(STRIP_LOW, 3973, cosine_of(r, TO_STRIP) >> 2);
  Color sum;
  for (int c = 0; c < 3; ++c)
    sum.c[c] = around[c] + ((MIRRORED_LAMP[c] * lamp) >> 12) + ((MIRRORED_STRIP[c] * strip) >> 12);
  return sum;
}

FN int highlight_at(PAINT, int table, int cosine) {
  GLOBAL const int* entry = K + table + (cosine >> 4);
  return entry[0] + (((entry[1] - entry[0]) * (cosine & 15)) >> 4);
}

// The bytes of matter at a position, by their number: liquid, heat, obstacle.
FN int share_byte(uint share, int number) { return (int)((share >> (8 * number)) & 255u); }
FN int share_at(CONSTANTS, GLOBAL const uint* shares, Vec position, int number) {
  long half_ = 524288;
  Vec p = vec(lclamp(position.x, half_, ((long)NX << CELL_BITS) - half_), lclamp(position.y, half_, ((long)NY << CELL_BITS) - half_),
              lclamp(position.z, half_, ((long)NZ << CELL_BITS) - half_));
  GLOBAL const uint* a = shares + place_at(P, (int)cell_below(p.x), (int)cell_below(p.y), (int)cell_below(p.z));
  GLOBAL const uint* b = a + WIDE * HIGH;
  int wx = weight_above(p.x), wy = weight_above(p.y);
  int low = blended(blended(share_byte(a[0], number), share_byte(a[1], number), wx),
                    blended(share_byte(a[WIDE], number), share_byte(a[WIDE + 1], number), wx), wy);
  int high = blended(blended(share_byte(b[0], number), share_byte(b[1], number), wx),
                     blended(share_byte(b[WIDE], number), share_byte(b[WIDE + 1], number), wx), wy);
  return blended(low, high, weight_above(p.z));
}

// Mixes the material of a surface: diffuse, mirror, highlight and gloss. Returns what it sends by itself.
FN Color material_of(PAINT, int liquid_byte, int heat, int obstacle, PRIVATE int* material) {
  int liquid = (liquid_byte << 4) + (liquid_byte >> 4);
  GLOBAL const int* solid = K + (TINTED ? TINTS + 10 * heat : OF_SOLID);
  for (int n = 0; n < 10; ++n) material[n] = mixed_by(solid[n], K[OF_LIQUID + n], liquid);
  Color emission = {{0, 0, 0}};
  if (GLOWS)
    for (int c = 0; c < 3; ++c) {
      material[c] += (K[GLOW_CRUSTS + 3 * heat + c] * liquid) >> 12;
      emission.c[c] = (((K[GLOW_LIGHTS + 3 * heat + c] * liquid) >> 12) * (LIGHT_ONE - obstacle)) >> 12;
    }
  for (int n = 0; n < 10; ++n) material[n] = mixed_by(material[n], K[OF_OBSTACLE + n], obstacle);
  return emission;
}

FN int lit_peak(PAINT, Vec normal, Vec to_eye, int obstacle, int lamp) {
  int shine = iclamp(cosine_of(normal, unit_of(K, added(TO_LIGHT, to_eye))), 0, LENGTH_ONE);
  int peak = highlight_at(K, HIGHLIGHTS, shine);
  if (obstacle > 0) peak = mixed_by(peak, highlight_at(K, DULL_HIGHLIGHTS, shine), obstacle);
  int facing = cosine_of(normal, TO_LIGHT);
  return (((peak * smooth_light(0, 1024, facing >> 2)) >> 12) * whole_of(lamp)) >> 8;
}

FN int obstacle_share(int obstacle) { return iclamp((obstacle - 148) * 73, 0, LIGHT_ONE); }

// The parts of the light from a surface. `normal` is on the eye's side, and `out` points out of the matter.
typedef struct {
  int mirrored[3], scattered[3], sent[3];
  int more, obstacle;  // the share that is mirrored of what comes from behind, and that of obstacles
} Shine;
FN Shine shine_of(CONSTANTS, VIEW, PAINT, GLOBAL const uint* shares, GLOBAL const uchar* lights, Vec position, Vec normal,
                  Vec out, Vec to_eye) {
  int liquid = share_at(P, shares, position, 0), heat = share_at(P, shares, position, 1), material[10];
  int obstacle = obstacle_share(share_at(P, shares, added(position, by(out, 32)), 2));
  Color emission = material_of(K, liquid, heat, obstacle, material);
  Light light = light_before(V, K, lights, position, out);
  Color arrives = arriving_light(K, out, &light, GLOWS && obstacle > 0);
  int peak = lit_peak(K, normal, to_eye, obstacle, light.lamp);
  int eye = iclamp(cosine_of(normal, to_eye), 0, LENGTH_ONE), away = LENGTH_ONE - eye;
  int away2 = (away * away) >> LENGTH_BITS, away4 = (away2 * away2) >> LENGTH_BITS;
  int more = (((away4 * away) >> LENGTH_BITS) * material[9]) >> LENGTH_BITS;
  long twice = (2 * dot_of(normal, to_eye)) >> LENGTH_BITS;
  Vec reflected = without(shifted(by(normal, twice), LENGTH_BITS), to_eye);
  Color around = mirrored_light(K, reflected);
  int free_ = whole_of(seen_along(light.open, reflected)) * whole_of(seen_along(light.open, normal));
  int seen = 614 + ((free_ * 3482) >> 16);
  Shine shine;
  shine.more = more;
  shine.obstacle = obstacle;
  for (int c = 0; c < 3; ++c) {
    int fresnel = material[3 + c] + (((LIGHT_ONE - material[3 + c]) * more) >> 12);
    shine.mirrored[c] = ((material[6 + c] * peak) >> 12) + ((((around.c[c] * seen) >> 12) * fresnel) >> 12);
    shine.scattered[c] = (arrives.c[c] * material[c]) >> 12;
    shine.sent[c] = (emission.c[c] * (2540 + ((1556 * eye) >> LENGTH_BITS))) >> 12;
  }
  return shine;
}
FN Color color_of_matter(CONSTANTS, VIEW, PAINT, GLOBAL const uint* shares, GLOBAL const uchar* lights, Vec position,
                         Vec normal, Vec to_eye) {
  Shine shine = shine_of(P, V, K, shares, lights, position, normal, normal, to_eye);
  Color sum;
  for (int c = 0; c < 3; ++c) sum.c[c] = shine.mirrored[c] + shine.scattered[c] + shine.sent[c];
  return sum;
}
