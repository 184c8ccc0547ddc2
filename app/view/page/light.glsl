// Light and colour (docs/picture/light.md, sections 5 to 7).

uniform usampler3D light;
uniform ivec3 light_cells;
uniform int light_shift;
uniform ivec3 to_light, to_strip, lamp, from_below, from_above;
uniform int solid[10], liquid[10], obstacle[10];
uniform ivec2 lamp_range, strip_range;
uniform int at_tone, at_highlight, at_dull_highlight, at_surroundings, at_glow, at_crust, at_tints;

// Four bytes at a time: the lamp's, six of openness, one that is free, six of glow.
uvec4 blended_bytes(uvec4 a, uvec4 b, int w) {
  const uint even = 0x00FF00FFu;
  uint by = uint(w), keep = 256u - by;
  return ((((a & even) * keep + (b & even) * by + 0x00800080u) >> 8) & even) |
         ((((a >> 8) & even) * keep + ((b >> 8) & even) * by + 0x00800080u) & (even << 8));
}
uvec4 light_of(int x, int y, int z) { return texelFetch(light, clamp(ivec3(x, y, z), ivec3(0), light_cells - 1), 0); }
uvec4 light_at(ivec3 position) {
  ivec3 s = (position >> light_shift) + kToPlace, c = s >> 20, d = c + 1, w = (s >> 12) & 255;
  return blended_bytes(
    blended_bytes(blended_bytes(light_of(c.x, c.y, c.z), light_of(d.x, c.y, c.z), w.x),
                  blended_bytes(light_of(c.x, d.y, c.z), light_of(d.x, d.y, c.z), w.x), w.y),
    blended_bytes(blended_bytes(light_of(c.x, c.y, d.z), light_of(d.x, c.y, d.z), w.x),
                  blended_bytes(light_of(c.x, d.y, d.z), light_of(d.x, d.y, d.z), w.x), w.y), w.z);
}
uvec4 light_before(ivec3 position, ivec3 normal) { return light_at(position + normal * (64 << light_shift)); }

int byte_of(uvec4 words, int i) { return int((words[i >> 2] >> (8 * (i & 3))) & 255u); }
const int kOpen = 1, kGlow = 8;  // first bytes of the six sides
int seen_along(uvec4 words, int first, ivec3 direction) {
  ivec3 w = (direction * direction) >> 14, side = ivec3(lessThan(direction, ivec3(0)));
  int all = w.x * byte_of(words, first + side.x) + w.y * byte_of(words, first + 2 + side.y) +
            w.z * byte_of(words, first + 4 + side.z);
  return min(all >> 14, 255);
}

int cosine(ivec3 a, ivec3 b) { return dot3(a, b) >> 14; }
int whole(int b) { return b + (b >> 7); }
int mixed(int a, int b, int w) { return a + rounded((b - a) * w, 12); }
ivec3 mixed(ivec3 a, ivec3 b, int w) { return a + (((b - a) * w + 2048) >> 12); }
int smooth_light(int low, int high, int v) {
  int t = (clamp(v - low, 0, high - low) * 4096) / (high - low), square = t * t, by = 12288 - 2 * t;
  return ((square >> 12) * by + (((square & 4095) * by) >> 12)) >> 12;
}

struct Material {
  ivec3 diffuse, mirror, highlight;
  int gloss;
};
Material material_of(int m[10]) {
  return Material(ivec3(m[0], m[1], m[2]), ivec3(m[3], m[4], m[5]), ivec3(m[6], m[7], m[8]), m[9]);
}
Material mixed(Material a, Material b, int w) {
  return Material(mixed(a.diffuse, b.diffuse, w), mixed(a.mirror, b.mirror, w), mixed(a.highlight, b.highlight, w),
                  mixed(a.gloss, b.gloss, w));
}
ivec3 entries(int at) { return ivec3(entry(at), entry(at + 1), entry(at + 2)); }
Material solid_of(ivec3 made_of) {
#ifdef TINTED
  int at = at_tints + 10 * made_of.y;
  return Material(entries(at), entries(at + 3), entries(at + 6), entry(at + 9));
#else
  return material_of(solid);
#endif
}

ivec3 arriving(ivec3 normal, uvec4 words, bool lit_by_glow) {
  int lit = (((max(cosine(normal, to_light) + 2458, 0) * 14247) >> 14) * whole(byte_of(words, 0))) >> 8;
  int open = whole(seen_along(words, kOpen, normal));
  ivec3 ambient = from_below + (((from_above - from_below) * (normal.y + 16384)) >> 15);
  ivec3 arrives = ((ambient * open) >> 8) + ((lamp * lit) >> 14);
#ifdef GLOW
  if (lit_by_glow) arrives += (ivec3(6144, 1966, 369) * seen_along(words, kGlow, normal)) >> 5;
#endif
  return arrives;
}

ivec3 mirrored_light(ivec3 r) {
  uint packed = uint(entry(at_surroundings + (clamp(r.y + 16384, 0, 32768) >> 4)));
  ivec3 around = ivec3((packed & 2047u) << 1, ((packed >> 11) & 2047u) << 1, (packed >> 22) << 2);
  int lamp_part = smooth_light(lamp_range.x, lamp_range.y, cosine(r, to_light) >> 2);
  int strip_part = smooth_light(strip_range.x, strip_range.y, cosine(r, to_strip) >> 2);
  return around + ((ivec3(9830, 9626, 9216) * lamp_part) >> 12) + ((ivec3(2867, 3072, 3482) * strip_part) >> 12);
}

int highlight_at(int table, int shine) {
  int first = entry(table + (shine >> 4)), next = entry(table + (shine >> 4) + 1);
  return first + (((next - first) * (shine & 15)) >> 4);
}
int obstacle_share(int b) { return clamp((b - 148) * 73, 0, 4096); }

struct Shine {
  ivec3 mirrored, scattered, emission;
  int more, obstacle;
};
// `normal` is on the eye's side, and `outside` points out of matter.
Shine shine_of(ivec3 normal, ivec3 outside, ivec3 to_eye, uvec4 words, ivec3 made_of) {
  Shine shine;
  int l = (made_of.x << 4) + (made_of.x >> 4), w = obstacle_share(made_of.z);
  Material material = mixed(solid_of(made_of), material_of(liquid), l);
  ivec3 emission = ivec3(0);
#ifdef GLOW
  material.diffuse += (entries(at_crust + 3 * made_of.y) * l) >> 12;
  emission = (((entries(at_glow + 3 * made_of.y) * l) >> 12) * (4096 - w)) >> 12;
#endif
#ifdef OBSTACLES
  material = mixed(material, material_of(obstacle), w);
#endif
  ivec3 arrives = arriving(outside, words, w > 0);
  int bright = clamp(cosine(normal, unit_of(to_light + to_eye)), 0, 16384);
  int peak = highlight_at(at_highlight, bright);
#ifdef OBSTACLES
  peak = mixed(peak, highlight_at(at_dull_highlight, bright), w);
#endif
  peak = (((peak * smooth_light(0, 1024, cosine(normal, to_light) >> 2)) >> 12) * whole(byte_of(words, 0))) >> 8;

  int eye = clamp(cosine(normal, to_eye), 0, 16384), a = 16384 - eye, a2 = (a * a) >> 14, a4 = (a2 * a2) >> 14;
  shine.more = (((a4 * a) >> 14) * material.gloss) >> 14;
  shine.obstacle = w;
  ivec3 r = ((normal * ((2 * dot3(normal, to_eye)) >> 14)) >> 14) - to_eye;
  int free = 614 + ((whole(seen_along(words, kOpen, r)) * whole(seen_along(words, kOpen, normal)) * 3482) >> 16);
  ivec3 fresnel = material.mirror + (((4096 - material.mirror) * shine.more) >> 12);
  shine.mirrored = ((material.highlight * peak) >> 12) + ((((mirrored_light(r) * free) >> 12) * fresnel) >> 12);
  shine.scattered = (arrives * material.diffuse) >> 12;
  shine.emission = (emission * (2540 + ((1556 * eye) >> 14))) >> 12;
  return shine;
}

ivec3 pressed(ivec3 c) {
  c = clamp(c, 0, 12287);
  return ivec3(entry(at_tone + c.x), entry(at_tone + c.y), entry(at_tone + c.z));
}
