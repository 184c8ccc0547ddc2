// docs/automaton.md section 5: keys, faces, and where rays start and end.
#include "rays.h"

#include <cstddef>
#include <vector>

namespace oracle {
namespace {

// floor(16384 cos((2c + 1) pi / 256)), as the page lists it.
constexpr Int COSINE[64] = {16382, 16372, 16353, 16323, 16284, 16234, 16175, 16107, 16028, 15940, 15842,
                            15735, 15618, 15492, 15357, 15212, 15058, 14895, 14723, 14543, 14353, 14155,
                            13948, 13733, 13510, 13278, 13038, 12791, 12536, 12273, 12003, 11726, 11442,
                            11150, 10853, 10548, 10237, 9920,  9597,  9268,  8934,  8594,  8249,  7900,
                            7545,  7186,  6822,  6455,  6083,  5708,  5329,  4948,  4563,  4175,  3785,
                            3393,  2998,  2602,  2204,  1805,  1405,  1004,  603,   201};

// n with its log2(R) bits in reverse order.
Int reversed(Int n, Int R) {
  Int result = 0;
  for (Int bit = 1; bit < R; bit *= 2) {
    result = 2 * result + n % 2;
    n /= 2;
  }
  return result;
}

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// 2^20 v / floor(sqrt(4096 |v|^2)), each component rounded down.
Point unit(const Point& v) {
  const Int length = square_root(4096 * squared_length(v));
  Point result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = floor_divide<Int>(v[axis] * (Int{1} << 20), length);
  return result;
}

// P + k D for the least whole k > 0 with which it has left the grid.
Point leaving(const Point& start, const Point& D, const std::array<Int, 3>& grid) {
  std::optional<Int> k;
  for (std::size_t b = 0; b < 3; ++b) {
    if (D[b] == 0) continue;
    // The steps to the border ahead, rounded up; at least one.
    const Int way = D[b] > 0 ? 16 * grid[b] - start[b] : start[b];
    const Int pace = D[b] > 0 ? D[b] : -D[b];
    const Int steps = larger(1, (way + pace - 1) / pace);
    if (!k || steps < *k) k = steps;
  }
  Point end = start;
  for (std::size_t axis = 0; axis < 3; ++axis) end[axis] += *k * D[axis];
  return end;
}

Point on_disc(const Key& sphere, const Point& delta, const OnDisc& place) {
  const auto magnitude = [&](std::size_t axis) { return delta[axis] < 0 ? -delta[axis] : delta[axis]; };
  std::size_t e = 0;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (magnitude(axis) < magnitude(e)) e = axis;
  const std::size_t e1 = (e + 1) % 3, e2 = (e + 2) % 3;
  Point g{};
  g[e1] = delta[e2];
  g[e2] = -delta[e1];
  const Point G = unit(g), F = unit(delta), product = cross(F, G);
  Point end{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Int V = product[axis] >> 14;
    end[axis] = sphere.at[axis] + ((sphere.radius * (place.p * G[axis] + place.q * V)) >> 28);
  }
  return end;
}

Point sky_direction(const Face& face, const OnDisc& place) {
  Point H{};
  H[face.axis] = face.side * square_root((Int{1} << 28) - place.rho * place.rho);
  H[(face.axis + 1) % 3] = place.p;
  H[(face.axis + 2) % 3] = place.q;
  return H;
}

}  // namespace

// All numbers of a source at step s, from its keys.
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

std::optional<Cast> cast_from(const Point& start, const Face& face, const Light& light, const Turns& turns,
                              const RayNumber& ray, const std::array<Int, 3>& grid) {
  const Key& now = light.now;
  switch (light.kind) {
    case Kind::directional: {
      const Int w = face.side * now.direction[face.axis];
      if (w <= 0) return std::nullopt;
      return Cast{leaving(start, now.direction, grid), w};
    }
    case Kind::sky: {
      const Point H = sky_direction(face, turns.place(ray));
      if (H[1] <= 0) return std::nullopt;
      return Cast{leaving(start, H, grid), 1};
    }
    case Kind::point:
    case Kind::sphere:
      break;
  }
  Point end = now.at;
  if (light.kind == Kind::sphere) {
    const Point delta = difference(now.at, face.cell);
    if (squared_length(delta) == 0) return std::nullopt;  // its disc is turned nowhere
    end = on_disc(now, delta, turns.place(ray));
  }
  const Int w = face.side * (end[face.axis] - face.cell[face.axis]);
  if (w <= 8) return std::nullopt;
  return Cast{end, w};
}

}  // namespace oracle
