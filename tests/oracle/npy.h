// Files of NumPy's format 1.0 (docs/automaton.md section 14): |u1 or <u2, C order.
#pragma once
#include "arithmetic.h"

#include <array>
#include <string>
#include <vector>

namespace oracle {

std::vector<Int> read_npy(const std::string& path, const std::array<Int, 3>& shape, Int width);
void write_npy(const std::string& path, const std::array<Int, 3>& shape, Int width,
               const std::vector<Int>& values);

}  // namespace oracle
