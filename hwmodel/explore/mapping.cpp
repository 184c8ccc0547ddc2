#include "hwmodel/explore/mapping.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <tuple>
#include <utility>

namespace voxmelt::hwmodel::explore {
namespace {

std::int64_t up(std::int64_t a, std::int64_t b) { return (a + b - 1) / b; }

// Parts of one shape, or -1. Words beyond those of a part lie in rows behind one another. Each byte of a part
// is written by itself, so rows share parts, byte by byte. Rows weigh too, since one must be chosen.
std::int64_t parts_for(const std::vector<MemoryShape>& shapes, std::int64_t words, std::int64_t bits,
                       const Family& f) {
  std::int64_t parts = -1, least = 0;
  for (const MemoryShape& shape : shapes) {
    const std::int64_t rows = up(words, shape.words), byte = std::min(f.byte_bits, shape.bits);
    const std::int64_t n = up(rows * up(bits, byte), shape.bits / byte);
    const std::int64_t weight = n * f.part_mux_bits + (rows - 1) * bits;
    if (parts >= 0 && std::pair(weight, n) >= std::pair(least, parts)) continue;
    parts = n;
    least = weight;
  }
  return parts;
}

}  // namespace

std::int64_t luts_to_hold(std::int64_t words, std::int64_t bits, const Family& f) {
  std::int64_t fewest = -1;
  for (const MemoryShape& shape : f.lutram) {
    const std::int64_t deep = up(words, shape.words);
    const std::int64_t luts = deep * up(bits, shape.bits) * shape.luts + bits * up(deep - 1, f.mux_ways - 1);
    if (fewest < 0 || luts < fewest) fewest = luts;
  }
  return fewest;
}

std::vector<MemoryUse> ways_to_hold(std::int64_t words, std::int64_t bits, const Family& f) {
  std::vector<MemoryUse> ways;
  if (words <= f.deepest_lutram) ways.push_back({luts_to_hold(words, bits, f), 0, 0});
  if (const std::int64_t n = parts_for(f.bram, words, bits, f); n >= 0) ways.push_back({0, n, 0});
  if (const std::int64_t n = parts_for(f.uram, words, bits, f); n >= 0) ways.push_back({0, 0, n});
  return ways;
}

std::vector<MemoryUse> sums_of(const std::vector<MemoryUse>& a, const std::vector<MemoryUse>& b) {
  std::vector<MemoryUse> all;
  for (const MemoryUse& x : a)
    for (const MemoryUse& y : b) all.push_back(x + y);
  std::sort(all.begin(), all.end(), [](const MemoryUse& x, const MemoryUse& y) {
    return std::tie(x.lutram, x.parts, x.uram) < std::tie(y.lutram, y.parts, y.uram);
  });
  // All that come before have no more LUTs. A stair tells the fewest URAMs that any of them has, with at most
  // so many parts of BRAM: it falls as the parts grow.
  std::map<std::int64_t, std::int64_t> stair;
  std::vector<MemoryUse> kept;
  for (const MemoryUse& x : all) {
    auto above = stair.upper_bound(x.parts);
    if (above != stair.begin() && std::prev(above)->second <= x.uram) continue;
    while (above != stair.end() && above->second >= x.uram) above = stair.erase(above);
    stair[x.parts] = x.uram;
    kept.push_back(x);
  }
  return kept;
}

}  // namespace voxmelt::hwmodel::explore
