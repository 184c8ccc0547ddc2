// Keys, faces, the starts of rays and their turns follow docs/automaton.md section 5.
#include "rays.h"

#include <cstddef>
#include <vector>

namespace oracle {
namespace {

// The page lists floor(16384 cos((2c + 1) pi / 256)).
constexpr Int COSINE[64] = {16382, 16372, 16353, 16323, 16284, 16234, 16175, 16107, 16028, 15940, 15842,
                            15735, 15618, 15492, 15357, 15212, 15058, 14895, 14723, 14543, 14353, 14155,
                            13948, 13733, 13510, 13278, 13038, 12791, 12536, 12273, 12003, 11726, 11442,
                            11150, 10853, 10548, 10237, 9920,  9597,  9268,  8934,  8594,  8249,  7900,
                            7545,  7186,  6822,  6455,  6083,  5708,  5329,  4948,  4563,  4175,  3785,
                            3393,  2998,  2602,  2204,  1805,  1405,  1004,  603,   201};

// Returns n with its log2(R) bits in reverse order.
Int reversed(Int n, Int R) {
  Int result = 0;
  for (Int bit = 1; bit < R; bit *= 2) {
    result = 2 * result + n % 2;
    n /= 2;
  }
  return result;
}

}  // namespace

// Returns all numbers of a source at step s, from its keys.
Key key_at(const RadiationSource& source, Int s) {
  const std::vector<Key>& keys = source.keys;
  if (s < keys.front().step) return keys.front();
  for (std::size_t n = 0; n + 1 < keys.size(); ++n) {
    const Key &a = keys[n], &b = keys[n + 1];
    if (s < a.step || s >= b.step) continue;
    const auto between = [&](Int from, Int to) {
      const Sum way = Sum{to - from} * (s - a.step);
      return from + static_cast<Int>(floor_divide<Sum>(way, b.step - a.step));
    };
    Key now;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      now.at[axis] = between(a.at[axis], b.at[axis]);
      now.direction[axis] = between(a.direction[axis], b.direction[axis]);
    }
    now.radius = between(a.radius, b.radius);
    now.power = between(a.power, b.power);
    return now;
  }
  return keys.back();
}

Point centre_of(Place cell) { return {16 * cell.x + 8, 16 * cell.y + 8, 16 * cell.z + 8}; }

Point difference(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }

Int squared_length(const Point& v) { return v[0] * v[0] + v[1] * v[1] + v[2] * v[2]; }

Face face_of(Place cell, Int f) {
  Face face;
  face.cell = centre_of(cell);
  face.axis = f / 2;
  face.side = f % 2 == 0 ? 1 : -1;
  face.beyond = {cell.x, cell.y, cell.z};
  face.beyond[face.axis] += face.side;
  return face;
}

Point start_of(const Face& face, Int n, Int R) {
  const Int m = square_root(R), i = n / m, j = n % m;
  const std::size_t a1 = (face.axis + 1) % 3, a2 = (face.axis + 2) % 3;
  Point start = face.cell;
  start[face.axis] += 8 * face.side;
  start[a1] += -8 + (16 * i + 8) / m;
  start[a2] += -8 + (16 * j + 8) / m;
  return start;
}

OnDisc Turns::place(const RayNumber& ray) const {
  const std::uint64_t W = words.word(ray.f, ray.cell);
  const Int turned = static_cast<Int>(W % 65536) + 65536 * ray.n / ray.R;
  const Int spread = static_cast<Int>(W / 65536 % 65536) + 65536 * reversed(ray.n, ray.R) / ray.R;
  const Int u = turned % 65536, v = spread % 65536;
  OnDisc place{};
  place.rho = square_root(2048 * (2 * v + 1));
  const Int c = u / 256 % 64;
  place.p = 1 + ((place.rho * COSINE[c]) >> 14);
  place.q = 1 + ((place.rho * COSINE[63 - c]) >> 14);
  for (Int t = u / 16384; t > 0; --t) {
    const Int p = place.p;
    place.p = -place.q;
    place.q = p;
  }
  return place;
}

}  // namespace oracle
