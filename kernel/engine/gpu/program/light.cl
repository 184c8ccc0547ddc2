// The irradiance from heat sources (docs/automaton.md, section 5): which rays a cell has, which of them see their
// source, and what it receives. KINDS has a bit for each kind of source that the scene has.
#define POINT 0
#define SPHERE 1
#define SUN 2
#define SKY 3
#define IS_KIND(which) ((KINDS & (1 << (which))) != 0 && source.kind == (which))
#define IRRADIANCE_MAX 65535
#define FACES 6
#define BRICK_CELLS (BRICK_X * BRICK_Y * BRICK_Z)

// floor(16384 cos((2c + 1) pi / 256))
TABLE int COSINE[64] = {16382, 16372, 16353, 16323, 16284, 16234, 16175, 16107, 16028, 15940, 15842, 15735, 15618,
                        15492, 15357, 15212, 15058, 14895, 14723, 14543, 14353, 14155, 13948, 13733, 13510, 13278,
                        13038, 12791, 12536, 12273, 12003, 11726, 11442, 11150, 10853, 10548, 10237, 9920,  9597,
                        9268,  8934,  8594,  8249,  7900,  7545,  7186,  6822,  6455,  6083,  5708,  5329,  4948,
                        4563,  4175,  3785,  3393,  2998,  2602,  2204,  1805,  1405,  1004,  603,   201};

// A source at a step. What its kind lacks is 0.
typedef struct {
  int kind;
  Triple at, way;  // of a sun: the direction to it
  int radius;
  ulong power;
} Source;

// Returns the number of an axis, and a place from its numbers along an axis and the two that follow it.
FN int along_axis(Triple p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }
FN Triple by_axis(int axis, int along, int second, int third) {
  Triple on_x = {along, second, third}, on_y = {third, along, second}, on_z = {second, third, along};
  return axis == 0 ? on_x : axis == 1 ? on_y : on_z;
}
FN Triple middle_of(Triple c) {
  Triple middle = {UNIT * c.x + UNIT / 2, UNIT * c.y + UNIT / 2, UNIT * c.z + UNIT / 2};
  return middle;
}
FN Triple from_to(Triple from, Triple to) {
  Triple way = {to.x - from.x, to.y - from.y, to.z - from.z};
  return way;
}
FN ulong squared(Triple p) { return (ulong)((long)p.x * p.x + (long)p.y * p.y + (long)p.z * p.z); }

// Returns floor(sqrt(a)), digit by digit.
FN ulong square_root(ulong a) {
  ulong root = 0, bit = (ulong)1 << 62;
  while (bit > a) bit >>= 2;
  for (; bit != 0; bit >>= 2) {
    ulong least = root + bit;
    root >>= 1;
    if (a < least) continue;
    a -= least;
    root += bit;
  }
  return root;
}

// Returns floor(a b / (c d)), but 65536 where it is more: a cell is cut there. Both products have up to 128 bits.
FN uint quotient(ulong a, ulong b, ulong c, ulong d) {
  ulong high = MUL_HIGH(a, b), low = a * b, by_high = MUL_HIGH(c, d), by_low = c * d;
  uint result = 0;
  for (int k = 16; k >= 0; --k) {
    ulong h = k == 0 ? by_high : by_high << k | by_low >> (64 - k), l = by_low << k;
    if (high < h || (high == h && low < l)) continue;
    if (k == 16) return IRRADIANCE_MAX + 1;
    high -= h + (low < l ? 1 : 0);
    low -= l;
    result |= 1u << k;
  }
  return result;
}

// The random word of a cell's face, of which its lower half is asked for.
FN uint ray_word(CONSTANTS, GLOBAL const int* tables, Triple c, int face) {
  uint X = (uint)face, Y = ((uint)c.z * (uint)NY + (uint)c.y) * (uint)NX + (uint)c.x;
  for (int round = 0; round < 10; ++round) {
    X = (((X >> 8) | (X << 24)) + Y) ^ (uint)tables[RAY_KEYS + round];
    Y = ((Y << 3) | (Y >> 29)) ^ X;
  }
  return Y;
}

// A place on a disc of radius 16384: how far from the middle, and where.
typedef struct {
  int rho, p, q;
} Turn;
FN Turn turn_of(CONSTANTS, uint word, int n) {
  uint rays = RAY_SIDE * RAY_SIDE, each = 65536u / rays, reversed = 0, bits = (uint)n;
  for (uint k = 1; k < rays; k *= 2, bits >>= 1) reversed = reversed << 1 | (bits & 1u);
  uint u = (word + each * (uint)n) & 0xFFFFu, v = ((word >> 16) + each * reversed) & 0xFFFFu;
  int rho = (int)square_root((2 * v + 1) << 11), c = (int)(u >> 8 & 63u);
  int p = 1 + ((rho * COSINE[c]) >> 14), q = 1 + ((rho * COSINE[63 - c]) >> 14);
  for (uint t = u >> 14; t > 0; --t) {
    int old = p;
    p = -q;
    q = old;
  }
  Turn turn = {rho, p, q};
  return turn;
}

// Two vectors of length 16384 at right angles to each other and to the way to a sphere.
typedef struct {
  Triple g, v;
} Axes;
FN int floored(long over, long under) { return (int)(over / under - (over % under < 0 ? 1 : 0)); }
FN Triple lengthened(Triple p) {
  long length = (long)square_root(squared(p) << 12), one = (long)1 << 20;
  Triple longer = {floored(p.x * one, length), floored(p.y * one, length), floored(p.z * one, length)};
  return longer;
}
FN Axes disc_axes(Triple d) {
  int least = size_of(d.y) < size_of(d.x) ? 1 : 0;
  if (size_of(d.z) < size_of(least == 0 ? d.x : d.y)) least = 2;
  Triple g = lengthened(by_axis(least, 0, along_axis(d, (least + 2) % 3), -along_axis(d, (least + 1) % 3)));
  Triple f = lengthened(d);
  Triple v = {(int)(((long)f.y * g.z - (long)f.z * g.y) >> 14), (int)(((long)f.z * g.x - (long)f.x * g.z) >> 14),
             (int)(((long)f.x * g.y - (long)f.y * g.x) >> 14)};
  Axes axes = {g, v};
  return axes;
}
FN int on_disc(int at, long radius, Turn turn, int g, int v) {
  return (int)(at + ((radius * ((long)turn.p * g + (long)turn.q * v)) >> 28));
}

// Returns after how many ways a ray has left the grid along an axis.
FN int times_out(int start, int way, int cells) {
  if (way == 0) return 0x7FFFFFFF;
  int room = way > 0 ? UNIT * cells - start : start, each = size_of(way);
  return imax(1, (room + each - 1) / each);
}
FN Triple leaving(CONSTANTS, Triple start, Triple way) {
  int k = imin(imin(times_out(start.x, way.x, NX), times_out(start.y, way.y, NY)), times_out(start.z, way.z, NZ));
  Triple end = {start.x + k * way.x, start.y + k * way.y, start.z + k * way.z};
  return end;
}

// A ray's end, and its weight. With 0 it is not cast.
typedef struct {
  Triple end;
  int weight;
} Ray;
FN Ray ray_of(CONSTANTS, Source source, Axes axes, Triple middle, int face, uint word, int n, Triple start) {
  Ray ray = {source.at, 0};
  int axis = face / 2, side = face % 2 == 0 ? 1 : -1;
  if (IS_KIND(SUN)) {
    ray.weight = imax(0, side * along_axis(source.way, axis));
    if (ray.weight > 0) ray.end = leaving(P, start, source.way);
    return ray;
  }
  if (IS_KIND(SKY)) {
    Turn turn = turn_of(P, word, n);
    int height = (int)square_root((ulong)((1 << 28) - turn.rho * turn.rho));
    Triple way = by_axis(axis, side * height, turn.p, turn.q);
    ray.weight = way.y > 0;
    if (ray.weight > 0) ray.end = leaving(P, start, way);
    return ray;
  }
  if (IS_KIND(SPHERE)) {
    Turn turn = turn_of(P, word, n);
    ray.end.x = on_disc(source.at.x, source.radius, turn, axes.g.x, axes.v.x);
    ray.end.y = on_disc(source.at.y, source.radius, turn, axes.g.y, axes.v.y);
    ray.end.z = on_disc(source.at.z, source.radius, turn, axes.g.z, axes.v.z);
  }
  int weight = side * along_axis(from_to(middle, ray.end), axis);
  ray.weight = weight > UNIT / 2 ? weight : 0;
  return ray;
}

// Tells if a face may have rays that are cast. It is true wherever one is.
FN int may_look(CONSTANTS, Source source, Triple middle, int face) {
  int axis = face / 2, side = face % 2 == 0 ? 1 : -1;
  if (IS_KIND(SUN)) return side * along_axis(source.way, axis) > 0;
  if (IS_KIND(SKY)) return axis != 1 || side > 0;
  int reach = IS_KIND(SPHERE) ? source.radius + source.radius / 8 + 1 : 0;
  return side * along_axis(from_to(middle, source.at), axis) + reach > UNIT / 2;
}

// Returns what a cell receives, whose rays that see the source weigh so much together.
FN uint received(CONSTANTS, Source source, Triple middle, long weight) {
  ulong rays = RAY_SIDE * RAY_SIDE, sum = (ulong)weight, one_cell = UNIT * UNIT;
  if (weight == 0) return 0;
  if (IS_KIND(SKY)) return quotient(source.power, sum, one_cell * rays, 1);
  if (IS_KIND(SUN))
    return quotient(source.power, 64 * sum, one_cell * rays, square_root(squared(source.way) << 12));
  ulong distance = squared(from_to(middle, source.at)), radius = IS_KIND(SPHERE) ? (ulong)source.radius : 0;
  if (distance < radius * radius) distance = radius * radius;
  if (distance < one_cell) distance = one_cell;
  return quotient(source.power, 64 * sum, distance, rays * square_root(distance << 12));
}

// Returns a bit for each face of a solid cell that is free and may look at the source.
FN uint looking_faces(CONSTANTS, GLOBAL const uchar* F, Source source, Triple c, int i) {
  uint faces = 0;
  Triple middle = middle_of(c);
  for (int face = 0; face < FACES; ++face) {
    int side = face % 2 == 0 ? 1 : -1, at = along_axis(c, face / 2) + side;
    int size = face / 2 == 0 ? NX : face / 2 == 1 ? NY : NZ, step = face / 2 == 0 ? 1 : face / 2 == 1 ? ROW : SLICE;
    if (!may_look(P, source, middle, face)) continue;
    if (at < 0 || at >= size || !is_blocked(F[i + side * step])) faces |= 1u << face;
  }
  return faces;
}

// Returns how much the rays of a cell weigh together that see the source, and counts those that are cast.
FN long weight_seeing(CONSTANTS, GLOBAL const int* tables, GLOBAL const ulong* cubes, GLOBAL const ulong* blocks,
                      Source source, Triple c, uint faces, PRIVATE long* rays) {
  Triple middle = middle_of(c), way = from_to(middle, source.at);
  Axes axes = {{0, 0, 0}, {0, 0, 0}};
  long sum = 0;
  if (IS_KIND(SPHERE)) {
    if (squared(way) == 0) return 0;
    axes = disc_axes(way);
  }
  for (int face = 0; face < FACES; ++face) {
    if (((faces >> face) & 1u) == 0) continue;
    int axis = face / 2, side = face % 2 == 0 ? 1 : -1, square = UNIT / RAY_SIDE;
    uint word = IS_KIND(SPHERE) || IS_KIND(SKY) ? ray_word(P, tables, c, face) : 0;
    Triple beyond = by_axis(axis, along_axis(c, axis) + side, along_axis(c, (axis + 1) % 3),
                            along_axis(c, (axis + 2) % 3));
    int along = along_axis(middle, axis) + side * (UNIT / 2);
    int second = along_axis(middle, (axis + 1) % 3) - UNIT / 2 + square / 2;
    int third = along_axis(middle, (axis + 2) % 3) - UNIT / 2 + square / 2;
    for (int n = 0; n < RAY_SIDE * RAY_SIDE; ++n) {
      Triple start = by_axis(axis, along, second + n / RAY_SIDE * square, third + n % RAY_SIDE * square);
      Ray ray = ray_of(P, source, axes, middle, face, word, n, start);
      if (ray.weight == 0) continue;
      *rays += 1;
      if (sees(P, cubes, blocks, walk_of(beyond, start, ray.end))) sum += ray.weight;
    }
  }
  return sum;
}

// Adds the light of one source to all solid cells, each cut at the largest. A group first finds the cells of a brick
// that look at the source, so that its items share them.
KERNEL(add_light)(CONSTANTS, GLOBAL const int* tables, GLOBAL const uchar* F, GLOBAL const ulong* cubes,
                  GLOBAL const ulong* blocks, GLOBAL ushort* irradiance, GLOBAL long* books, GLOBAL const int* list,
                  GLOBAL const int* counts, int kind, int at_x, int at_y, int at_z, int radius, int way_x, int way_y,
                  int way_z, uint power_low, uint power_high) {
  if (KINDS == 0) return;  // such a program leaves out all of this
  SCRATCH
  SHARED ushort looking[BRICK_CELLS];
  SHARED int many[1];
  Source source = {kind, {at_x, at_y, at_z}, {way_x, way_y, way_z}, radius, (ulong)power_high << 32 | power_low};
  long cut = 0, rays = 0;
  for (int listed = GROUP; listed < counts[FULL]; listed += GROUPS) {
    int brick = list[listed], x0 = (brick % BRICKS_X - 1) * BRICK_X, y0 = (brick / BRICKS_X % BRICKS_Y - 1) * BRICK_Y;
    int z0 = (brick / (BRICKS_X * BRICKS_Y) - 1) * BRICK_Z;
    if (LANE == 0) many[0] = 0;
    BARRIER;
    for (int k = LANE; k < BRICK_CELLS; k += LANES) {
      Triple c = {x0 + k % BRICK_X, y0 + k / BRICK_X % BRICK_Y, z0 + k / (BRICK_X * BRICK_Y)};
      int i = cell_at(P, c.x, c.y, c.z);
      if (!is_inside(P, c) || (F[i] & SOLID) == 0u) continue;
      uint faces = looking_faces(P, F, source, c, i);
      if (faces != 0u) looking[NEXT(many)] = (ushort)((uint)k | faces << 9);
    }
    BARRIER;
    for (int n = LANE; n < many[0]; n += LANES) {
      int k = looking[n] % BRICK_CELLS;
      Triple c = {x0 + k % BRICK_X, y0 + k / BRICK_X % BRICK_Y, z0 + k / (BRICK_X * BRICK_Y)};
      int i = cell_at(P, c.x, c.y, c.z);
      long weight = weight_seeing(P, tables, cubes, blocks, source, c, (uint)looking[n] / BRICK_CELLS, &rays);
      uint sum = irradiance[i] + received(P, source, middle_of(c), weight);
      if (sum > IRRADIANCE_MAX) ++cut;
      irradiance[i] = (ushort)(sum > IRRADIANCE_MAX ? IRRADIANCE_MAX : sum);
    }
    BARRIER;
  }
  book(books, scratch, LIGHT_CUT, cut);
  book(books, scratch, LIGHT_RAYS, rays);
}

// What a cell takes in warms its own matter alone. It comes after all sources.
KERNEL(share_light)(CONSTANTS, GLOBAL const ushort* A, GLOBAL ushort* irradiance, GLOBAL const int* list,
                    GLOBAL const int* counts, MOMENTS, int now) {
  FOR_LISTED_CELLS(list, counts[FULL]) {
    CELL
    uint sum = irradiance[i], most = IRRADIANCE_MAX;
    if (sum == 0) continue;
    note(&WARM_AT(brick), now);
    uint amount = (uint)imax(1, A[i]), share = ONE * sum / amount;
    irradiance[i] = (ushort)(share < most ? share : most);
  }
}
