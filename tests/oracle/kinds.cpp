// The table has a row for each kind of source (docs/automaton.md section 5).
#include "kinds.h"

#include <cstddef>

namespace oracle {
namespace {

Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// Returns 2^20 v / floor(sqrt(4096 |v|^2)), each component rounded down.
Point unit(const Point& v) {
  const Int length = square_root(4096 * squared_length(v));
  Point result{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    result[axis] = floor_divide<Int>(v[axis] * (Int{1} << 20), length);
  return result;
}

// Returns P + k D for the least whole k > 0 with which it has left the grid.
Point leaving(const Point& start, const Point& D, const std::array<Int, 3>& grid) {
  std::optional<Int> k;
  for (std::size_t b = 0; b < 3; ++b) {
    if (D[b] == 0) continue;
    // These are the steps to the border ahead, rounded up, and at least one.
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

// An end that is not beyond the face is no end.
std::optional<Cast> cast_to(const Point& end, const Face& face) {
  const Int w = face.side * (end[face.axis] - face.cell[face.axis]);
  if (w <= 8) return std::nullopt;
  return Cast{end, w};
}

// A place counts as no nearer than one cell, or than `radius`.
Sum from_a_place(const Key& now, const Point& centre, Int N, Int R, Int radius) {
  const Int distance = squared_length(difference(now.at, centre));
  const Int d2 = larger(larger(distance, radius * radius), 256);
  return 64 * Sum{now.power} * N / (Sum{R} * d2 * square_root(4096 * d2));
}

std::optional<Cast> cast_to_point(const Look& look) { return cast_to(look.now.at, look.face); }
Sum from_point(const Key& now, const Point& centre, Int N, Int R) {
  return from_a_place(now, centre, N, R, 0);
}

std::optional<Cast> cast_to_sphere(const Look& look) {
  const Point delta = difference(look.now.at, look.face.cell);
  if (squared_length(delta) == 0) return std::nullopt;  // its disc is turned nowhere
  return cast_to(on_disc(look.now, delta, look.turns.place(look.ray)), look.face);
}
Sum from_sphere(const Key& now, const Point& centre, Int N, Int R) {
  return from_a_place(now, centre, N, R, now.radius);
}

std::optional<Cast> cast_to_sun(const Look& look) {
  const Int w = look.face.side * look.now.direction[look.face.axis];
  if (w <= 0) return std::nullopt;
  return Cast{leaving(look.start, look.now.direction, look.grid), w};
}
Sum from_sun(const Key& now, const Point&, Int N, Int R) {
  return 64 * Sum{now.power} * N / (Sum{256} * R * square_root(4096 * squared_length(now.direction)));
}

std::optional<Cast> cast_to_sky(const Look& look) {
  const Point H = sky_direction(look.face, look.turns.place(look.ray));
  if (H[1] <= 0) return std::nullopt;
  return Cast{leaving(look.start, H, look.grid), 1};
}
Sum from_sky(const Key& now, const Point&, Int N, Int R) { return Sum{now.power} * N / (256 * R); }

constexpr Kind KINDS[] = {
    // The columns are name, at, radius, direction.
    {"point", true, false, false, cast_to_point, from_point},
    {"sphere", true, true, false, cast_to_sphere, from_sphere},
    {"directional", false, false, true, cast_to_sun, from_sun},
    {"sky", false, false, false, cast_to_sky, from_sky},
};

}  // namespace

const Kind* kind_named(const std::string& name) {
  for (const Kind& kind : KINDS)
    if (kind.name == name) return &kind;
  return nullptr;
}

}  // namespace oracle
