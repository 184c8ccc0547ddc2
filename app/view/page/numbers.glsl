// Integers as docs/picture/definition.md has them: `>>` rounds down, and no sum wraps but where it says so.

precision highp float;
precision highp int;
precision highp isampler3D;
precision highp usampler3D;

uniform isampler3D tables;
uniform int at_roots;

int entry(int at) { return texelFetch(tables, ivec3(at & 1023, at >> 10, 0), 0).x; }

int rounded(int a, int n) { return (a + (1 << (n - 1))) >> n; }

// The same as (below (256 - w) + above w + 128) >> 8, without a wider product.
int blended(int below, int above, int w) { return ((below << 8) + (above - below) * w + 128) >> 8; }
ivec3 blended(ivec3 below, ivec3 above, int w) { return ((below << 8) + (above - below) * w + 128) >> 8; }

int bits_of(uint a) {
  int n = 0;
  if (a >= 65536u) { n += 16; a >>= 16; }
  if (a >= 256u) { n += 8; a >>= 8; }
  if (a >= 16u) { n += 4; a >>= 4; }
  if (a >= 4u) { n += 2; a >>= 2; }
  if (a >= 2u) { n += 1; a >>= 1; }
  return n + int(a);
}

int dot3(ivec3 a, ivec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
int largest(ivec3 a) { return max(max(abs(a.x), abs(a.y)), abs(a.z)); }

// Section 8: a vector is brought to the length 2^14.
ivec3 unit(ivec3 a) {
  int most = largest(a);
  if (most == 0) return a;
  a *= 1 << (15 - bits_of(uint(most)));
  uint q = uint(a.x * a.x) + uint(a.y * a.y) + uint(a.z * a.z);
  int e = q < (1u << 30) ? 1 : 0;
  uint m = q << (2 * e);
  int i = int(m >> 23) - 128;
  int first = entry(at_roots + i), next = entry(at_roots + i + 1);
  int root = first - rounded((first - next) * int(m & 0x7FFFFFu), 23);
  return (a * (root << e) + 32768) >> 16;
}
ivec3 unit_of(ivec3 a) {
  int bits = bits_of(uint(largest(a)));
  return unit(bits > 15 ? a >> (bits - 14) : a);
}

// --- Numbers of 64 bits, for directions and starts of rays ---

struct Wide { int high; uint low; };

Wide wide_of(ivec2 pair) { return Wide(pair.x, uint(pair.y)); }
Wide sum(Wide a, Wide b) {
  uint low = a.low + b.low;
  return Wide(a.high + b.high + (low < a.low ? 1 : 0), low);
}
Wide times(Wide a, uint b) {
  uint a0 = a.low & 65535u, a1 = a.low >> 16, b0 = b & 65535u, b1 = b >> 16;
  uint low = a0 * b0, middle = a0 * b1 + (low >> 16), other = a1 * b0 + (middle & 65535u);
  uint high = a1 * b1 + (middle >> 16) + (other >> 16);
  return Wide(int(high) + a.high * int(b), (other << 16) | (low & 65535u));
}
Wide magnitude(Wide a) {
  if (a.high >= 0) return a;
  uint low = ~a.low + 1u;
  return Wide(~a.high + (low == 0u ? 1 : 0), low);
}
bool less(Wide a, Wide b) { return a.high < b.high || (a.high == b.high && a.low < b.low); }
Wide shifted(Wide a, int n) {  // to the right, 1 <= n
  if (n >= 32) return Wide(a.high >> 31, uint(a.high >> (n - 32)));
  return Wide(a.high >> n, (a.low >> n) | (uint(a.high) << (32 - n)));
}
float float_of(Wide a) { return float(a.high) * 4294967296.0 + float(a.low); }
