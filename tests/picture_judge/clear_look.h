// Clear matter lets light pass as docs/picture/translucent.md sections 1 and 2 say.
#pragma once

#include <algorithm>

#include "input.h"

class ClearLook {
 public:
  explicit ClearLook(const Input& in) {
    const Vec clear{scaled_number(in.clear.red, 6), scaled_number(in.clear.green, 6),
                    scaled_number(in.clear.blue, 6)};
    frost = scaled_number(in.frost, 12);
    is_clear = !in.glows && (clear.x > 0 || clear.y > 0 || clear.z > 0);
    for (int channel = 0; channel < 3; ++channel)
      loss.at(channel) =
          std::min<Int>(floor_divided(power_of_two(18), std::max<Int>(clear.at(channel), 1)), 4096);
    Int E = power_of_two(30);
    for (int i = 0; i < 2047; ++i) {
      passing.push_back(rounded(E, 15));
      E = rounded(E * 1070838486, 30);
    }
    passing.push_back(0);
  }
  // Returns the light that passes a way in 2^-8 cells.
  Int passes(Int way, Int lost) const { return passing[std::min<Int>((way * lost) >> 12, 2047)]; }

  bool is_clear = false;
  Int frost = 0;
  Vec loss;

 private:
  Ints passing;
};
