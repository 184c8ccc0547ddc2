#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "hwmodel/pipeline/model/conduction_pass.h"

namespace voxmelt::hwmodel {

std::vector<std::int64_t> tap_delays(const Shape& shape, std::span<const HeatPair> pairs) {
  std::vector<std::int64_t> delays;
  for (const HeatPair& pair : pairs)
    for (const unsigned corner : {pair.p, pair.q, pair.p & ~kWest, pair.q & ~kWest})
      delays.push_back(corner_delay(shape, corner));
  std::sort(delays.begin(), delays.end());
  delays.erase(std::unique(delays.begin(), delays.end()), delays.end());
  return delays;
}

std::vector<BufferCost> heat_buffers(const Design& design, std::span<const HeatPair> pairs,
                                     int exposed_bits) {
  const Shape& shape = design.shape;
  const int bits = heat_word_bits(design, exposed_bits);
  const std::vector<std::int64_t> delays = tap_delays(shape, pairs);
  std::vector<BufferCost> costs;
  for (std::size_t i = 1; i < delays.size(); ++i) {
    const std::int64_t from = delays[i - 1], words = delays[i] - from;
    const bool plane = delays[i] == shape.plane() && from >= shape.column();
    const char* name = words == 1 ? "token register" : plane ? "plane memory" : "column memory";
    if (from <= shape.plane()) {
      costs.push_back({name, words, shape.lanes, bits});
      continue;
    }
    // Behind the last row, only the lane beside the next block still has partners and needs temperatures.
    if (shape.lanes > 1) costs.push_back({name, words, shape.lanes - 1, bits - 16});
    costs.push_back({name, words, 1, bits});
  }
  return costs;
}

void add_material_tables(const Design& design, std::span<const HeatPair> pairs, std::int64_t words,
                         std::vector<BufferCost>& buffers) {
  if (!design.of_materials()) return;
  const std::int64_t lanes = design.shape.lanes;
  buffers.push_back({"weights of pairs", words, lanes * static_cast<std::int64_t>(pairs.size()), 16});
  add_table(buffers, "curves", design, Curves::kBits);
}

}  // namespace voxmelt::hwmodel
