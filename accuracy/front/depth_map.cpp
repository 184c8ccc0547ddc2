#include "accuracy/front/depth_map.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "accuracy/cells.h"

namespace voxmelt::accuracy::front {
namespace {

struct Share {
  int square = 0;
  double part = 0;
};

// Returns the squares along one axis that a cell lies in, and the part of the cell in each.
std::vector<Share> shares_of(int cell, double grid) {
  constexpr double kSliver = 1e-9;
  const double begin = cell / (grid * kSquareSide), end = (cell + 1) / (grid * kSquareSide);
  std::vector<Share> shares;
  for (int square = static_cast<int>(std::floor(begin)); square < end; ++square) {
    const double part = (std::min(end, square + 1.) - std::max(begin, 1. * square)) / (end - begin);
    if (part > kSliver) shares.push_back({square, part});
  }
  return shares;
}

double liquid_of_column(const state::Volume& volume, int x, int z) {
  double liquid = 0;
  for (int y = 0; y < volume.grid.y; ++y)
    if (volume.liquid.test(x, y, z) && !volume.solid.test(x, y, z))
      liquid += volume.amount[volume.at(x, y, z)] / kOne;
  return liquid;
}

double at(const DepthMap& map, const std::pair<int, int>& square) {
  const auto found = map.find(square);
  return found == map.end() ? 0 : found->second;
}

}  // namespace

DepthMap map_of(const state::Volume& volume, double grid) {
  DepthMap map;
  for (int z = 0; z < volume.grid.z; ++z)
    for (int x = 0; x < volume.grid.x; ++x) {
      const double liquid = liquid_of_column(volume, x, z) / (grid * grid * grid);
      if (liquid == 0) continue;
      for (const Share& along_x : shares_of(x, grid))
        for (const Share& along_z : shares_of(z, grid))
          map[{along_x.square, along_z.square}] += liquid * along_x.part * along_z.part;
    }
  return map;
}

double part_elsewhere(const DepthMap& found, const DepthMap& reference) {
  double difference = 0, sum = 0;
  for (const auto& [square, liquid] : reference) {
    difference += std::abs(at(found, square) - liquid);
    sum += liquid;
  }
  for (const auto& [square, liquid] : found)
    if (reference.count(square) == 0) difference += liquid;
  return difference == 0 ? 0 : difference / (2 * sum);
}

}  // namespace voxmelt::accuracy::front
