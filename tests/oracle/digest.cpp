// The digest follows docs/automaton.md section 13.
#include <cstdint>

#include "state.h"

namespace oracle {
namespace {

std::uint64_t m(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9u;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBu;
  return v ^ (v >> 31);
}

}  // namespace

std::uint64_t digest(const State& state) {
  std::uint64_t total = 0;
  std::uint64_t number = 0;  // i + 1
  for (const Cell& cell : state.cells) {
    ++number;
    const Int packed = cell.amount + (Int{1} << 16) * cell.energy + (Int{1} << 32) * cell.heat +
                       (Int{1} << 48) * cell.solid + (Int{1} << 49) * cell.liquid +
                       (Int{1} << 50) * cell.inert + (Int{1} << 51) * cell.material;
    if (packed != 0) total += m(static_cast<std::uint64_t>(packed) + 0x9E3779B97F4A7C15u * number);
  }
  return total;
}

}  // namespace oracle
