// Rays and the field (docs/picture/definition.md, sections 4 to 8 and 12).
// Positions in the lattice, here called q, are those of a sample's cell and weight, with two cells before the grid.

uniform ivec2 corner[3], to_right[3], to_below[3];  // directions, at the upper left and a 64th of a pixel further
uniform ivec2 near_corner[3], near_right[3], near_below[3], begin[3];  // starts on the near plane
uniform int spacing;  // steps are 2^-spacing cells
uniform ivec3 cells;
uniform usampler3D levels, matter, blocks;

const int kCell = 1 << 20;
const int kToPlace = 2048 - 524288;
const int kBias = kToPlace + 2 * kCell;

struct Ray {
  ivec3 start;  // in 2^-20 cells, its low 32 bits
  vec3 far;     // the same, roughly
  ivec3 step;
};

Ray ray_through(uvec2 place) {
  Wide direction[3];
  Wide most = Wide(0, 0u);
  Ray ray;
  for (int i = 0; i < 3; ++i) {
    direction[i] = sum(wide_of(corner[i]), sum(times(wide_of(to_right[i]), place.x), times(wide_of(to_below[i]), place.y)));
    Wide size = magnitude(direction[i]);
    if (less(most, size)) most = size;
    Wide near = sum(wide_of(near_corner[i]),
                    sum(times(wide_of(near_right[i]), place.x), times(wide_of(near_below[i]), place.y)));
    Wide start = sum(wide_of(begin[i]), shifted(near, 10));
    ray.start[i] = int(start.low);
    ray.far[i] = float_of(start);
  }
  most = sum(most, Wide(-1, 0xFFFFFFFFu));
  int bits = most.high > 0 ? 32 + bits_of(uint(most.high)) : bits_of(most.low);
  int shift = bits - (20 - spacing);
  Wide half_unit = Wide(0, 0u);
  if (shift > 32) half_unit.high = 1 << (shift - 33);
  else half_unit.low = 1u << (shift - 1);
  for (int i = 0; i < 3; ++i) ray.step[i] = int(shifted(sum(direction[i], half_unit), shift).low);
  return ray;
}

// Samples that may lie in a box, and one or two beside it.
ivec2 samples_in(Ray ray, vec3 low, vec3 high) {
  float first = 0.0, last = 1e9;
  for (int i = 0; i < 3; ++i) {
    float before = low[i] - ray.far[i], behind = high[i] - ray.far[i];
    if (ray.step[i] == 0) {
      if (before > 4096.0 || behind < -4096.0) return ivec2(1, 0);
      continue;
    }
    float step = float(ray.step[i]), a = before / step, b = behind / step;
    first = max(first, min(a, b));
    last = min(last, max(a, b));
  }
  const float more = 1.0 / 1048576.0;
  return ivec2(int(min(max(first - first * more - 1.0, 0.0), 1e9)), int(max(last + last * more + 1.0, -1.0)));
}

int level_of(ivec3 place) {
  return int(texelFetch(levels, min(place, textureSize(levels, 0) - 1), 0).x) - 32640;
}
int sample_at(ivec3 q) {
  ivec3 c = q >> 20, d = c + 1, w = (q >> 12) & 255;
  return blended(
    blended(blended(level_of(c), level_of(ivec3(d.x, c.yz)), w.x),
            blended(level_of(ivec3(c.x, d.y, c.z)), level_of(ivec3(d.xy, c.z)), w.x), w.y),
    blended(blended(level_of(ivec3(c.xy, d.z)), level_of(ivec3(d.x, c.y, d.z)), w.x),
            blended(level_of(ivec3(c.x, d.yz)), level_of(d), w.x), w.y), w.z);
}

struct Hit {
  bool found;
  int k, level;  // first sample in matter
  ivec3 at;      // its place in the lattice
};

// Looks for the first sample in matter from `from` to `most`. A block without matter, and those around it, are left
// out. So are samples where the level cannot have risen far enough.
Hit march(Ray ray, int from, int most) {
  const float less = 1.0 - 1.0 / 262144.0;
  ivec2 range = samples_in(ray, vec3(float(-kCell - kToPlace)), vec3(cells) * 1048576.0 - float(kToPlace));
  int k = max(range.x, from), last = min(range.y, most);
  ivec3 q = ray.start + kBias + ray.step * k, count = textureSize(blocks, 0);
  ivec3 back = -ivec3(lessThan(ray.step, ivec3(0)));
  vec3 inverse = 1.0 / vec3(abs(ray.step));
  float rise = 1.0 / float(768 >> spacing);
  while (k <= last) {
    ivec3 block = q >> 22;
    int advance = 1;
    if (block == clamp(block, ivec3(0), count - 1)) {
      int record = int(texelFetch(blocks, block, 0).x);
      bool air = record < 256;
      ivec3 way = ((air ? record : 1) << 22) + back - ((q ^ back) & ((1 << 22) - 1));
      vec3 leave = vec3(way) * inverse;
      advance = int(min(min(min(leave.x, leave.y), leave.z) * less, 1e8)) + 1;
      if (!air) {
        int level = sample_at(q), slope = record & 255;
        if (level >= 0) return Hit(true, k, level, q);
        float steps = float(-level - 4 - 3 * slope) / float(max(slope, 1)) * rise;
        advance = min(advance, int(max(steps * less, 0.0)) + 1);
      }
    }
    k += advance;
    q += ray.step * advance;
  }
  return Hit(false, 0, 0, ivec3(0));
}

struct Crossing {
  int part;  // of the step to the sample in matter, in 2048ths
  ivec3 at;
};

Crossing crossing_between(ivec3 outside, ivec3 inside, int high) {
  int low = sample_at(outside), part = 0;
  for (int i = 0; i < 3; ++i) {
    ivec3 middle = outside + ((inside - outside) >> 1);
    int level = sample_at(middle);
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
  int last = (-low * 256) / max(high - low, 1);
  return Crossing(part * 256 + last, outside + (((inside - outside) * last) >> 8));
}
Crossing crossing_of(Ray ray, Hit hit) {
  if (hit.k == 0) return Crossing(2048, hit.at);
  return crossing_between(hit.at - ray.step, hit.at, hit.level);
}

// The spline's weights of a cell and its two neighbours: values, and slopes.
void spline(int u, out ivec3 value, out ivec3 slope) {
  int t = 256 - u, low = (t * t) >> 9, high = (u * u) >> 9;
  value = ivec3(low, 256 - low - high, high);
  slope = ivec3(-t, t - u, u);
}
ivec3 normal_at(ivec3 q) {
  ivec3 middle = q + kCell / 2, first = (middle >> 20) - 1, u = (middle >> 12) & 255;
  ivec3 vx, vy, vz, sx, sy, sz, slope_x, slope_y, value;
  spline(u.x, vx, sx);
  spline(u.y, vy, sy);
  spline(u.z, vz, sz);
  for (int k = 0; k < 3; ++k) {
    ivec3 slopes, values;
    for (int j = 0; j < 3; ++j) {
      ivec3 row = ivec3(level_of(first + ivec3(0, j, k)), level_of(first + ivec3(1, j, k)), level_of(first + ivec3(2, j, k)));
      slopes[j] = rounded(dot3(row, sx), 9);
      values[j] = rounded(dot3(row, vx), 8);
    }
    slope_x[k] = rounded(dot3(slopes, vy), 8);
    slope_y[k] = rounded(dot3(values, sy), 9);
    value[k] = rounded(dot3(values, vy), 8);
  }
  return unit(-ivec3(rounded(dot3(slope_x, vz), 8), rounded(dot3(slope_y, vz), 8), rounded(dot3(value, sz), 9)));
}

// Liquid, heat or tone, and obstacle (docs/picture/light.md, section 3).
ivec3 matter_of(ivec3 place) { return ivec3(texelFetch(matter, place, 0).xyz); }
ivec3 matter_at(ivec3 q) {
  q = clamp(q, ivec3(kBias + kCell / 2), cells * kCell + (kBias - kCell / 2));
  ivec3 c = q >> 20, d = c + 1, w = (q >> 12) & 255;
  return blended(
    blended(blended(matter_of(c), matter_of(ivec3(d.x, c.yz)), w.x),
            blended(matter_of(ivec3(c.x, d.y, c.z)), matter_of(ivec3(d.xy, c.z)), w.x), w.y),
    blended(blended(matter_of(ivec3(c.xy, d.z)), matter_of(ivec3(d.x, c.y, d.z)), w.x),
            blended(matter_of(ivec3(c.x, d.yz)), matter_of(d), w.x), w.y), w.z);
}
