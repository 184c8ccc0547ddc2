// The grid of light (docs/picture/light.md, sections 4 and 5). A cell of light has 16 bytes: the lamp, openness from six
// sides, and the glow from six sides.
#define LIGHT_BYTES 16
#define OPEN_BYTES 1
#define GLOW_BYTES 7
#define SIDES 6
#define LIGHT_CELLS (LIGHT_X * LIGHT_Y * LIGHT_Z)

// The density of clear matter, of which obstacles are not thinned (docs/picture/translucent.md, section 8).
FN int thinned_density(int all, int obstacle, int share) {
  int opaque = imin(all, obstacle), clear = all - opaque;
  return opaque + (clear <= 12 ? clear : 12 + (((clear - 12) * share) >> 8));
}

// `matter` has two bytes a cell of light: density and emission. `ground` has the drawn heights first.
KERNEL(find_density)(CONSTANTS, VIEW, PAINT, GLOBAL const ushort* all, GLOBAL const int* ground, GLOBAL uchar* matter) {
  GLOBAL const ushort* liquids = all + (ulong)LIQUID_PART * (ulong)PLACES;
  GLOBAL const ushort* heats = all + (ulong)HEAT_PART * (ulong)PLACES;
  GLOBAL const ushort* obstacles = all + (ulong)OBSTACLE_PART * (ulong)PLACES;
  int s = LIGHT_SHIFT, side = 1 << s;
  for (int n = GROUP * LANES + LANE; n < LIGHT_CELLS; n += GROUPS * LANES) {
    int x0 = n % LIGHT_X << s, y0 = n / LIGHT_X % LIGHT_Y << s, z0 = n / (LIGHT_X * LIGHT_Y) << s;
    long filled = 0, opaque = 0, earth = 0, sent = 0;
    for (int z = z0; z < imin(z0 + side, NZ); ++z)
      for (int x = x0; x < imin(x0 + side, NX); ++x) {
        if (GROUND_HIGHEST > 0) earth += lclamp((long)ground[z * NX + x] - 4096 * (long)y0, 0, (long)4096 << s);
        for (int y = y0; y < imin(y0 + side, NY); ++y) {
          int at = place_at(P, x, y, z);
          filled += all[at];
          if (CLEAR) opaque += obstacles[at];
          if (!GLOWS) continue;
          int liquid = liquids[at], heat = heat_share(K, liquid, heats[at]);
          sent += (liquid * ((heat * heat) >> 8)) >> 16;
        }
      }
    int own = (int)(filled >> (3 * s + 8));
    if (CLEAR) own = thinned_density(own, (int)(opaque >> (3 * s + 8)), DENSITY_SHARE);
    matter[2 * n] = (uchar)lmax(own, (255 * earth) >> (3 * s + 12));
    matter[2 * n + 1] = (uchar)(sent >> (3 * s));
  }
}

FN int passed_light(int arrived, int density) {
  int loss = iclamp((density - 12) * 3 / 2, 0, 256);
  return (arrived * (256 - loss) + 128) >> 8;
}

// The slices of a sweep. u and v are the two other axes, in the order x, y, z.
typedef struct {
  int count, u, v;               // slices, and cells of a slice
  int along, step_u, step_v;     // cells of light to the next slice, and to the next cell
  int from_high;
} Slices;
FN Slices slices_of(VIEW, int axis, int from_high) {
  Slices on_x = {LIGHT_X, LIGHT_Y, LIGHT_Z, 1, LIGHT_X, LIGHT_X * LIGHT_Y, from_high};
  Slices on_y = {LIGHT_Y, LIGHT_X, LIGHT_Z, LIGHT_X, 1, LIGHT_X * LIGHT_Y, from_high};
  Slices on_z = {LIGHT_Z, LIGHT_X, LIGHT_Y, LIGHT_X * LIGHT_Y, 1, LIGHT_X, from_high};
  return axis == 0 ? on_x : axis == 1 ? on_y : on_z;
}
FN int light_cell(Slices slices, int s, int u, int v) {
  return (slices.from_high ? slices.count - 1 - s : s) * slices.along + u * slices.step_u + v * slices.step_v;
}
// The room of a sweep: no slice is larger.
FN int slice_room(VIEW) { return imax(imax(LIGHT_X * LIGHT_Y, LIGHT_Y * LIGHT_Z), LIGHT_X * LIGHT_Z); }

// What leaves a cell of the slice before. Sweeps 0 to 5 are of openness, and the others of glow.
FN int leaving(GLOBAL const uchar* matter, GLOBAL const uchar* light, Slices slices, int sweep, int s, int u, int v) {
  int outside = sweep < SIDES ? 255 : 0;
  if (s < 0 || u < 0 || v < 0 || u >= slices.u || v >= slices.v) return outside;
  int n = light_cell(slices, s, u, v), arrived = light[n * LIGHT_BYTES + OPEN_BYTES + sweep];
  int left = passed_light(arrived, matter[2 * n]);
  return sweep < SIDES ? left : imin(left + matter[2 * n + 1], 255);
}

// Slice s of every sweep is made in two parts: `along` gets what is spread along u.
KERNEL(sweep_u)(CONSTANTS, VIEW, GLOBAL const uchar* matter, GLOBAL const uchar* light, GLOBAL uchar* along, int sweeps,
                int s) {
  int room = slice_room(V);
  for (int n = GROUP * LANES + LANE; n < sweeps * room; n += GROUPS * LANES) {
    int sweep = n / room, side = sweep % SIDES, m = n % room;
    Slices slices = slices_of(V, side / 2, side % 2 == 0);
    if (s >= slices.count || m >= slices.u * slices.v) continue;
    int u = m % slices.u, v = m / slices.u, sum = 4;
    for (int d = -2; d <= 2; ++d)
      sum += leaving(matter, light, slices, sweep, s - 1, u + d, v) * (d == -2 || d == 2 ? 1 : 2);
    along[n] = (uchar)(sum >> 3);
  }
}
KERNEL(sweep_v)(CONSTANTS, VIEW, GLOBAL const uchar* along, GLOBAL uchar* light, int sweeps, int s) {
  int room = slice_room(V);
  for (int n = GROUP * LANES + LANE; n < sweeps * room; n += GROUPS * LANES) {
    int sweep = n / room, side = sweep % SIDES, m = n % room;
    Slices slices = slices_of(V, side / 2, side % 2 == 0);
    if (s >= slices.count || m >= slices.u * slices.v) continue;
    int u = m % slices.u, v = m / slices.u, sum = 4;
    for (int d = -2; d <= 2; ++d) {
      int there = v + d < 0 || v + d >= slices.v ? (sweep < SIDES ? 255 : 0) : along[n + d * slices.u];
      sum += there * (d == -2 || d == 2 ? 1 : 2);
    }
    int value = sum >> 3;
    value = sweep < SIDES ? value + ((255 - value + 7) >> 3) : value - ((value + 8) >> 4);
    light[light_cell(slices, s, u, v) * LIGHT_BYTES + OPEN_BYTES + sweep] = (uchar)value;
  }
}

// The lamp's rays. Those beside the kept ones hold 255.
FN int lamp_ray(VIEW, GLOBAL const uchar* rays, int a, int b) {
  return a < 0 || b < 0 || a >= LAMP_RAYS_U || b >= LAMP_RAYS_V ? 255 : rays[b * LAMP_RAYS_U + a];
}
FN int lamp_loss(GLOBAL const uchar* matter, Slices slices, int s, int u, int v) {
  if (u < 0 || v < 0 || u >= slices.u || v >= slices.v) return 0;
  return iclamp((matter[2 * light_cell(slices, s, u, v)] - 12) * 3 / 2, 0, 256);
}
KERNEL(begin_lamp)(CONSTANTS, VIEW, GLOBAL uchar* rays) {
  for (int n = GROUP * LANES + LANE; n < LAMP_RAYS_U * LAMP_RAYS_V; n += GROUPS * LANES) rays[n] = 255;
}
// What arrives in slice s, and what of it is left behind.
KERNEL(pass_lamp)(CONSTANTS, VIEW, GLOBAL const uchar* matter, GLOBAL const uchar* rays, GLOBAL uchar* left,
                  GLOBAL uchar* light, int s) {
  Slices slices = slices_of(V, LAMP_AXIS, LAMP_FROM_HIGH);
  int way_u = (int)(((long)s * LAMP_SLOPE_U) >> 6), way_v = (int)(((long)s * LAMP_SLOPE_V) >> 6);
  int cells_u = way_u >> 8, part_u = way_u & 255, cells_v = way_v >> 8, part_v = way_v & 255;
  for (int n = GROUP * LANES + LANE; n < slices.u * slices.v; n += GROUPS * LANES) {
    int u = n % slices.u, v = n / slices.u, a = u + cells_u - LAMP_LOW_U, b = v + cells_v - LAMP_LOW_V;
    int here = blended(lamp_ray(V, rays, a, b), lamp_ray(V, rays, a + 1, b), part_u);
    int there = blended(lamp_ray(V, rays, a, b + 1), lamp_ray(V, rays, a + 1, b + 1), part_u);
    light[light_cell(slices, s, u, v) * LIGHT_BYTES] = (uchar)blended(here, there, part_v);
  }
  for (int n = GROUP * LANES + LANE; n < LAMP_RAYS_U * LAMP_RAYS_V; n += GROUPS * LANES) {
    int u = n % LAMP_RAYS_U + LAMP_LOW_U - cells_u, v = n / LAMP_RAYS_U + LAMP_LOW_V - cells_v;
    int here = blended(lamp_loss(matter, slices, s, u, v), lamp_loss(matter, slices, s, u - 1, v), part_u);
    int there = blended(lamp_loss(matter, slices, s, u, v - 1), lamp_loss(matter, slices, s, u - 1, v - 1), part_u);
    left[n] = (uchar)((rays[n] * (256 - blended(here, there, part_v)) + 128) >> 8);
  }
}
KERNEL(soften_lamp)(CONSTANTS, VIEW, GLOBAL const uchar* from, GLOBAL uchar* to, int axis) {
  for (int n = GROUP * LANES + LANE; n < LAMP_RAYS_U * LAMP_RAYS_V; n += GROUPS * LANES) {
    int a = n % LAMP_RAYS_U, b = n / LAMP_RAYS_U, da = axis == 0 ? 1 : 0, db = 1 - da;
    to[n] = (uchar)((lamp_ray(V, from, a - da, b - db) + 30 * from[n] + lamp_ray(V, from, a + da, b + db) + 16) >> 5);
  }
}
