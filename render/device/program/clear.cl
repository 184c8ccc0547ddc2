// Clear matter, followed front to back along a ray (docs/picture/translucent.md).
#define SCENE                                                                                                       \
  CONSTANTS, VIEW, PAINT, GLOBAL const short *levels, GLOBAL const uint *shares, GLOBAL const uchar *blocks,         \
      GLOBAL const uchar *lights, GLOBAL const int *ground, GLOBAL const ushort *texels
#define THIS_SCENE P, V, K, levels, shares, blocks, lights, ground, texels

#define MOST_WAY ((1 << 27) - 1)
#define NOTHING_PASSES 2047

// The ray, what surfaces and ways have left so far, and the light that has come along.
typedef struct {
  Ray ray;
  Vec to_eye;
  long step;          // its length, in 2^-16 cells
  int surfaces, way;  // 4096 is all of the light
  int mirrored[3], scattered[3];
} Walk;

FN int ground_is_first(VIEW, GroundCrossing met, Crossing matter) {
  if (!met.found || !matter.found) return met.found;
  long first = met.face == UPPER ? 0 : (long)1024 << HALVINGS;
  return met.part * 8 <= (matter.sample - 1) * 2048 + matter.part + first;
}

FN Color passed_by(PAINT, PRIVATE const Walk* walk) {
  Color share;
  for (int c = 0; c < 3; ++c) {
    int i = imin(((walk->way >> 8) * K[LOSSES + c]) >> 12, NOTHING_PASSES);
    share.c[c] = (walk->surfaces * K[PASSING + i]) >> 12;
  }
  return share;
}
FN int is_dark(PAINT, PRIVATE const Walk* walk) {
  Color share = passed_by(K, walk);
  return share.c[0] == 0 && share.c[1] == 0 && share.c[2] == 0;
}
FN int dimmed(int surfaces, int lost) { return (surfaces * (LIGHT_ONE - lost)) >> 12; }
FN int part_of_step(PRIVATE const Walk* walk, long a, int bits) { return (int)((walk->step * a) >> bits); }

// Adds light of a colour, in the share that no longer passes.
FN void scatter(PAINT, PRIVATE Walk* walk, Color before, PRIVATE const int* color) {
  Color after = passed_by(K, walk);
  for (int c = 0; c < 3; ++c) walk->scattered[c] += (before.c[c] - after.c[c]) * color[c];
}

// Takes the ray into matter or out of it.
FN void pass_surface(SCENE, PRIVATE Walk* walk, Vec position, int enters) {
  Vec out = normal_at(P, K, levels, position);
  Shine shine = shine_of(P, V, K, shares, lights, position, enters ? out : opposite_of(out), out, walk->to_eye);
  Color all = passed_by(K, walk);
  for (int c = 0; c < 3; ++c) walk->mirrored[c] += (all.c[c] * shine.mirrored[c]) >> 15;
  walk->surfaces = dimmed(walk->surfaces, shine.more);
  Color before = passed_by(K, walk);
  walk->surfaces = dimmed(walk->surfaces, mixed_by(FROST, LIGHT_ONE, shine.obstacle));
  scatter(K, walk, before, shine.scattered);
}

// Takes the ray along a way in matter, with the values at a place of it.
FN void walk_on(SCENE, PRIVATE Walk* walk, Vec position, int way) {
  int obstacle = obstacle_share(share_at(P, shares, position, 2)), material[10], color[3];
  material_of(K, share_at(P, shares, position, 0), share_at(P, shares, position, 1), obstacle, material);
  Light light = light_at(V, K, lights, position);
  int beside = light.open[0] + light.open[1] + light.open[4] + light.open[5];
  int above = ((2 * light.open[2] + beside) * 43) >> 9, below = ((2 * light.open[3] + beside) * 43) >> 9;
  for (int c = 0; c < 3; ++c) {
    int ambient = (K[FROM_ABOVE + c] * above + K[FROM_BELOW + c] * below) >> 8;
    color[c] = ((ambient + ((K[LAMP + c] * whole_of(light.lamp)) >> 9)) * material[c]) >> 12;
  }
  Color before = passed_by(K, walk);
  walk->way = imin(walk->way + way, MOST_WAY);
  walk->surfaces = dimmed(walk->surfaces, obstacle);
  scatter(K, walk, before, color);
}

// Takes the ray through one piece of matter, from sample *k on. Returns 1 if it gets to the ground, 2 if it gets out into
// the air after sample *k, and 0 if nothing is left of it.
FN int pass_matter(SCENE, PRIVATE Walk* walk, GroundCrossing met, long last, int way, PRIVATE long* k) {
  for (;; way = 0) {
    int is_out = 0;
    for (long i = 0; i < (long)1 << SPACING && *k < last; ++i) {
      is_out = sample_of(P, levels, ray_at(walk->ray, *k + 1)) < 0;
      if (is_out) break;
      ++*k;
      way += (int)walk->step;
    }
    Vec here = ray_at(walk->ray, *k);
    if (!is_out && *k == last) {
      walk_on(THIS_SCENE, walk, here, way + part_of_step(walk, met.part & 255, 8));
      return 1;
    }
    Crossing leaves = {0, 0, 0, {0, 0, 0}};
    if (is_out) {
      leaves = crossing_between(P, levels, ray_at(walk->ray, *k + 1), here, *k);
      way += part_of_step(walk, 2048 - leaves.part, 11);
    }
    walk_on(THIS_SCENE, walk, here, way);
    if (is_out) pass_surface(THIS_SCENE, walk, leaves.position, 0);
    if (is_dark(K, walk)) return 0;
    if (is_out) return 2;
  }
}

// Follows the ray from its first crossing on. Tells whether it gets to the ground.
FN int follow(SCENE, PRIVATE Walk* walk, GroundCrossing met, Crossing entry) {
  long last = met.found ? met.part >> 8 : 9223372036854775807L;
  while (!ground_is_first(V, met, entry)) {
    if (!entry.found) return 0;
    if (entry.sample > 0) pass_surface(THIS_SCENE, walk, entry.position, 1);
    if (is_dark(K, walk)) return 0;
    long k = entry.sample;
    if (k > last) {  // the ground follows within the step
      long place = (k - 1) * 2048 + entry.part;
      walk_on(THIS_SCENE, walk, ray_at(walk->ray, k), part_of_step(walk, met.part * 8 - place, 11));
      return 1;
    }
    int end = pass_matter(THIS_SCENE, walk, met, last, part_of_step(walk, 2048 - entry.part, 11), &k);
    if (end < 2) return end;
    entry = first_crossing(P, V, levels, blocks, walk->ray, k + 1);
  }
  return 1;
}
