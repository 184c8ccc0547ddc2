// The kinds of sources follow docs/automaton.md section 5: the numbers that their keys have, the table of
// where rays end, and what a cell receives.
#pragma once
#include "rays.h"

#include <array>
#include <optional>
#include <string>

namespace oracle {

struct Cast {
  Point end{};
  Int weight = 0;
};

// Holds a ray, and what its end depends on.
struct Look {
  Point start{};
  const Face& face;
  const Key& now;
  const Turns& turns;
  RayNumber ray;
  std::array<Int, 3> grid{};
};

struct Kind {
  const char* name;
  bool at, radius, direction;                                          // numbers that its keys have
  std::optional<Cast> (*cast)(const Look&);                            // nothing if the ray is not cast
  Sum (*received)(const Key& now, const Point& centre, Int N, Int R);  // irradiance of a cell, for N > 0
};

const Kind* kind_named(const std::string& name);  // null for none

}  // namespace oracle
