// Bodies of several materials follow docs/automaton.md section 6, "Materials".
#pragma once
#include "arithmetic.h"

#include <vector>

namespace oracle {

struct Material {
  Int melting_point = 0, latent_heat = 0;  // Tm, L
  Int warmth = 65536;                      // r
  Int F = 0;                               // the heat content that makes it liquid
  Int air_exchange = 0;
  // Each has the weights of its pairs with material 0, 1, and so on.
  std::vector<Int> weight_face, weight_edge, weight_corner;

  // Sets F by the numbers above it.
  void find_F() { F = (65536 * melting_point + warmth - 1) / warmth + latent_heat; }
  // Returns T(h) as far as it is not bound by top.
  Int unbound_temperature(Int h) const {
    const Int beyond = larger(melting_point, h - (F - melting_point));
    return smaller((h * warmth) >> 16, beyond);
  }
};

// Returns top.
Int top_of(const std::vector<Material>& materials);

}  // namespace oracle
