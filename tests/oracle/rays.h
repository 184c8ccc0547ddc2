// The rays of a cell follow docs/automaton.md section 5: where they start and end, and what they weigh.
#pragma once
#include "random.h"
#include "state.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace oracle {

Key key_at(const RadiationSource& source, Int s);

Point centre_of(Place cell);
Point difference(const Point& a, const Point& b);
Int squared_length(const Point& v);

struct Face {
  Point cell{};                 // C, the centre of its cell
  std::array<Int, 3> beyond{};  // the neighbour across it
  std::size_t axis = 0;         // a
  Int side = 1;                 // sigma
};
Face face_of(Place cell, Int f);
Point start_of(const Face& face, Int n, Int R);

// A ray number gives the random turn of the rays of spheres and skies.
struct RayNumber {
  Int cell, f, n, R;
};
struct OnDisc {
  Int p, q, rho;
};
class Turns {
 public:
  explicit Turns(std::uint64_t seed) : words(seed, RandomWords::TURNS) {}
  OnDisc place(const RayNumber& ray) const;

 private:
  RandomWords words;
};

}  // namespace oracle
