// Files of NumPy's format 1.0 are |u1 or <u2, in C order (docs/automaton.md section 14).
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
