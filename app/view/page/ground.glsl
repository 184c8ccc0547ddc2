// The ground (docs/picture/ground.md). Parts of a ray count in 256ths of its steps.

uniform isampler3D columns;
uniform usampler3D rock;
uniform int highest, fineness, band_count;
uniform ivec2 slopes;
uniform ivec3 ground_color;
uniform int at_bands, at_low_x, at_high_x, at_low_z, at_high_z;

const int kNoFace = 0, kLowX = 1, kHighX = 2, kLowZ = 3, kHighZ = 4, kUnder = 5, kTop = 6;

// x: the bare height, y: the drawn one.
ivec2 column(int x, int z) { return texelFetch(columns, ivec3(clamp(ivec2(x, z), ivec2(0), cells.xz - 1), 0), 0).xy; }
ivec2 heights_at(int x, int z) {
  ivec2 s = ivec2(x, z) + kToPlace, c = s >> 20, w = (s >> 12) & 255;
  ivec2 a = column(c.x, c.y), b = column(c.x + 1, c.y), d = column(c.x, c.y + 1), e = column(c.x + 1, c.y + 1);
  return ivec2(blended(blended(a.x, b.x, w.x), blended(d.x, e.x, w.x), w.y),
               blended(blended(a.y, b.y, w.x), blended(d.y, e.y, w.x), w.y));
}

ivec3 at_part(Ray ray, int part) { return ray.start + ray.step * (part >> 8) + ((ray.step * (part & 255)) >> 8); }
int above_ground(ivec3 p) { return (p.y >> 8) - heights_at(p.x, p.z).y; }

// The parts of the ray in the box around the ground, exactly: floats come near, and integers decide.
ivec2 ground_parts(Ray ray) {
  ivec3 high = ivec3(cells.x << 20, highest << 8, cells.z << 20);
  int first = 0, last = 1 << 29;
  for (int i = 0; i < 3; ++i) {
    float start = ray.far[i], step = float(ray.step[i]);
    if (ray.step[i] == 0) {
      if (abs(start) > 2e9 || ray.start[i] < 0 || ray.start[i] >= high[i]) return ivec2(1, 0);
      continue;
    }
    float low_part = -start * 256.0 / step, high_part = (float(high[i]) - start) * 256.0 / step;
    float enter = min(low_part, high_part), leave = max(low_part, high_part);
    if (leave < -16.0 || enter > 5e8) return ivec2(1, 0);
    bool up = ray.step[i] > 0;
    if (enter > -16.0) {
      int t = int(enter);
      for (int n = 0; n < 24; ++n) {
        int p = at_part(ray, t)[i], before = at_part(ray, t - 1)[i];
        if (up ? p < 0 : p >= high[i]) ++t;
        else if (up ? before >= 0 : before < high[i]) --t;
        else break;
      }
      first = max(first, t);
    }
    if (leave < 5e8) {
      int t = int(leave);
      for (int n = 0; n < 24; ++n) {
        int p = at_part(ray, t)[i], behind = at_part(ray, t + 1)[i];
        if (up ? p >= high[i] : p < 0) --t;
        else if (up ? behind < high[i] : behind >= 0) ++t;
        else break;
      }
      last = min(last, t);
    }
  }
  return ivec2(first, last);
}

struct Ground {
  bool found;
  int part, face;
  ivec3 position;
};

int face_before(ivec3 outside) {
  if (outside.x < 0) return kLowX;
  if (outside.x >= cells.x << 20) return kHighX;
  if (outside.z < 0) return kLowZ;
  if (outside.z >= cells.z << 20) return kHighZ;
  return outside.y < 0 ? kUnder : kTop;
}
bool in_ground(ivec3 p) {
  return p.x >= 0 && p.x < cells.x << 20 && p.z >= 0 && p.z < cells.z << 20 && p.y >= 0 && above_ground(p) < 0;
}

Ground first_ground(Ray ray) {
  const float more = 1.0 / 1048576.0;
  ivec2 range = ground_parts(ray);
  float aside = float(abs(ray.step.x)) * float(slopes.x) + float(abs(ray.step.z)) * float(slopes.y);
  float fall = -4096.0 * float(ray.step.y), nearer = aside + fall + (aside + abs(fall)) * more;
  float per_sample = nearer > 0.0 ? (1.0 - more * 4.0) / nearer : 1.0;
  float margin = float(slopes.x + slopes.y) * 8193.0 + 9437184.0;
  for (int part = range.x; part <= range.y;) {
    int above = above_ground(at_part(ray, part));
    if (above < 0) {
      int inside = part, outside = part == range.x ? part - 1 : max(range.x, (part - 1) & -256);
      while (inside - outside > 1) {
        int middle = (outside + inside) >> 1;
        if (in_ground(at_part(ray, middle))) inside = middle;
        else outside = middle;
      }
      int face = inside == 0 ? kNoFace : face_before(at_part(ray, outside));
      return Ground(true, inside, face, at_part(ray, inside));
    }
    if (part == range.y) break;
    float gap = float(above) * 1048576.0 - margin;
    int leap = gap > 0.0 ? int(min(nearer > 0.0 ? gap * per_sample : 1e6, 1e6)) : 0;
    part = min(((part >> 8) + leap + 1) << 8, range.y);
  }
  return Ground(false, 0, kNoFace, ivec3(0));
}

// --- Its normal and colour ---

int rim(int p, int count) {
  return (max(0, kCell / 2 - (count * kCell - p)) >> 7) - (max(0, kCell / 2 - p) >> 7);
}
ivec3 top_normal(ivec3 p) {
  const int h = kCell / 2;
  int x = heights_at(p.x - h, p.z).x - heights_at(p.x + h, p.z).x + rim(p.x, cells.x);
  int z = heights_at(p.x, p.z - h).x - heights_at(p.x, p.z + h).x + rim(p.z, cells.z);
  ivec3 slope = ivec3(x, 4096, z);
  return unit(slope >> max(0, bits_of(uint(largest(slope))) - 14));
}

#ifdef ROCK
int along(int at, int last, int position, int fine) {
  int s = position + (kToPlace >> fine), c = s >> (20 - fine);
  return blended(entry(at + clamp(c, 0, last)), entry(at + clamp(c + 1, 0, last)), (s >> (12 - fine)) & 255);
}
int band_at(ivec3 p, int face) {
  int bend = 0;
  if (face == kLowX) bend = along(at_low_x, cells.z - 1, p.z, 0);
  else if (face == kHighX) bend = along(at_high_x, cells.z - 1, p.z, 0);
  else if (face == kLowZ) bend = along(at_low_z, cells.x - 1, p.x, 0);
  else if (face == kHighZ) bend = along(at_high_z, cells.x - 1, p.x, 0);
  else return 0;
  return along(at_bands, band_count - 1, p.y + bend, 2);
}

// Red, green and blue, and the bumps along x and z.
void texel(ivec2 c, out ivec3 color, out ivec2 bump) {
  uvec2 word = texelFetch(rock, ivec3(clamp(c, ivec2(0), (cells.xz << fineness) - 1), 0), 0).xy;
  color = ivec3(word.x & 65535u, word.x >> 16, word.y & 65535u);
  bump = ivec2((int(word.y) << 8) >> 24, int(word.y) >> 24) << 6;
}
void rock_at(ivec3 p, out ivec3 color, out ivec2 bump) {
  ivec2 s = p.xz + (kToPlace >> fineness), c = s >> (20 - fineness), w = (s >> (12 - fineness)) & 255;
  ivec3 colors[4];
  ivec2 bumps[4];
  for (int i = 0; i < 4; ++i) texel(c + ivec2(i & 1, i >> 1), colors[i], bumps[i]);
  color = blended(blended(colors[0], colors[1], w.x), blended(colors[2], colors[3], w.x), w.y);
  for (int i = 0; i < 2; ++i)
    bump[i] = blended(blended(bumps[0][i], bumps[1][i], w.x), blended(bumps[2][i], bumps[3][i], w.x), w.y);
}
#endif

ivec3 paint_ground(Ground ground, ivec3 to_eye, out ivec3 normal) {
  normal = to_eye;
  int band = 0;
  if (ground.face == kTop) {
    normal = top_normal(ground.position);
    ivec3 color = ground_color;
#ifdef ROCK
    ivec2 bump;
    rock_at(ground.position, color, bump);
    normal = unit(normal + ivec3(bump.x, 0, bump.y));
#endif
    return color;
  }
  if (ground.face == kLowX) normal = ivec3(-16384, 0, 0);
  if (ground.face == kHighX) normal = ivec3(16384, 0, 0);
  if (ground.face == kLowZ) normal = ivec3(0, 0, -16384);
  if (ground.face == kHighZ) normal = ivec3(0, 0, 16384);
  if (ground.face == kUnder) normal = ivec3(0, -16384, 0);
#ifdef ROCK
  band = band_at(ground.position, ground.face);
#endif
  return (ground_color * (2540 + ((41 * band) >> 8))) >> 12;
}
