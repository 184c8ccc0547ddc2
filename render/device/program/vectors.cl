// Vectors of 64 bits, and the numbers of a picture (docs/picture/definition.md, section 1).
typedef struct {
  long x, y, z;
} Vec;
typedef struct {
  int c[3];
} Color;

FN Vec vec(long x, long y, long z) {
  Vec v = {x, y, z};
  return v;
}
FN Vec added(Vec a, Vec b) { return vec(a.x + b.x, a.y + b.y, a.z + b.z); }
FN Vec without(Vec a, Vec b) { return vec(a.x - b.x, a.y - b.y, a.z - b.z); }
FN Vec by(Vec a, long s) { return vec(a.x * s, a.y * s, a.z * s); }
FN Vec shifted(Vec a, int n) { return vec(a.x >> n, a.y >> n, a.z >> n); }
FN Vec opposite_of(Vec a) { return vec(-a.x, -a.y, -a.z); }
FN long dot_of(Vec a, Vec b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
FN long magnitude(long a) { return a < 0 ? -a : a; }
FN long largest(Vec a) { return lmax(lmax(magnitude(a.x), magnitude(a.y)), magnitude(a.z)); }
FN int bits_of(long a) { return 64 - LEADING_ZEROS((ulong)a); }
FN long lclamp(long a, long low, long high) { return lmax(low, lmin(a, high)); }
FN long floor_divided(long a, long b) { return a / b - (a % b < 0 ? 1 : 0); }
FN long ceil_divided(long a, long b) { return -floor_divided(-a, b); }
FN long rounded_to(long a, int n) { return (a + ((long)1 << (n - 1))) >> n; }

// What all rays of a picture share. The host writes them in this order (render/device/picture_numbers.cpp).
#define VIEW GLOBAL const long* V
#define VIEW_VECTOR(first) vec(V[first], V[(first) + 1], V[(first) + 2])
#define EYE VIEW_VECTOR(0)
#define FORWARD VIEW_VECTOR(3)
#define VIEW_WIDE VIEW_VECTOR(6)
#define VIEW_HIGH VIEW_VECTOR(9)
#define VIEW_NEAR V[12]
#define NEAR_WIDE VIEW_VECTOR(13)
#define NEAR_HIGH VIEW_VECTOR(16)
#define HALF_WIDTH V[19]
#define HALF_HEIGHT V[20]
#define HALVINGS ((int)V[21])
#define SPACING ((int)V[22])
#define WIDTH ((int)V[23])
#define HEIGHT ((int)V[24])
#define GROUND_HIGHEST V[25]  // 0: no ground
#define GROUND_SLOPE_X V[26]
#define GROUND_SLOPE_Z V[27]
#define GROUND_COLOR VIEW_VECTOR(28)
#define ROCK ((int)V[31])  // the ground has a texture
#define FINENESS ((int)V[32])
#define BANDS ((int)V[33])
#define LIGHT_X ((int)V[34])
#define LIGHT_Y ((int)V[35])
#define LIGHT_Z ((int)V[36])
#define LIGHT_SHIFT ((int)V[37])
#define LAMP_AXIS ((int)V[38])
#define LAMP_FROM_HIGH ((int)V[39])
#define LAMP_SLOPE_U ((int)V[40])
#define LAMP_SLOPE_V ((int)V[41])
#define LAMP_LOW_U ((int)V[42])
#define LAMP_LOW_V ((int)V[43])
#define LAMP_RAYS_U ((int)V[44])
#define LAMP_RAYS_V ((int)V[45])

// The look, the materials and the tables of a picture, in this order, too.
#define PAINT GLOBAL const int* K
#define PAINT_VECTOR(first) vec(K[first], K[(first) + 1], K[(first) + 2])
#define TO_LIGHT PAINT_VECTOR(0)
#define TO_STRIP PAINT_VECTOR(3)
#define LAMP 6
#define FROM_BELOW 9
#define FROM_ABOVE 12
#define OF_SOLID 15  // a material: diffuse, mirror and highlight with three numbers each, and the gloss
#define OF_LIQUID 25
#define OF_OBSTACLE 35
#define GLOWS K[45]
#define TINTED K[46]
#define LAMP_MIRROR_LOW K[47]
#define LAMP_MIRROR_HIGH K[48]
#define STRIP_LOW K[49]
#define BACKGROUND 50
#define GLOW_COLD K[53]
#define GLOW_HOT K[54]
#define CLEAR K[55]
#define LOSSES 56
#define FROST K[59]
#define DENSITY_SHARE K[60]
#define INVERSE_ROOTS 64
#define HIGHLIGHTS 512
#define DULL_HIGHLIGHTS 1600
#define SURROUNDINGS 2688
#define GLOW_LIGHTS 4800
#define GLOW_CRUSTS 5568
#define TINTS 6336
#define TONES 8960
#define BYTES 21312
#define PASSING 25472

#define LENGTH_BITS 14
#define LENGTH_ONE 16384
#define LIGHT_ONE 4096

// Brings a vector within 2^15 to the length 2^14 (section 8).
FN Vec unit(PAINT, Vec a) {
  if (a.x == 0 && a.y == 0 && a.z == 0) return a;
  a = by(a, (long)1 << (15 - bits_of(largest(a))));
  long square = dot_of(a, a);
  int more = square < ((long)1 << 30) ? 1 : 0;
  long m = square << (2 * more);
  int i = INVERSE_ROOTS + (int)(m >> 23) - 128;
  long scale = (K[i] - rounded_to((K[i] - K[i + 1]) * (m & 0x7FFFFF), 23)) << more;
  return vec(rounded_to(a.x * scale, 16), rounded_to(a.y * scale, 16), rounded_to(a.z * scale, 16));
}
FN Vec unit_of(PAINT, Vec a) {
  int bits = bits_of(largest(a));
  return unit(K, bits > 15 ? shifted(a, bits - 14) : a);
}

FN int blended(int below, int above, int weight) { return (below * (256 - weight) + above * weight + 128) >> 8; }

// The cell below a position along an axis, and the weight of the one above (section 6).
#define CELL_BITS 20
#define TO_PLACE (2048 - 524288)
FN long cell_below(long p) { return (p + TO_PLACE) >> CELL_BITS; }
FN int weight_above(long p) { return (int)((p + TO_PLACE) >> 12) & 255; }
