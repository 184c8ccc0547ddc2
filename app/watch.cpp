#include "app/watch.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>

namespace voxmelt::app {
namespace {

constexpr int kFull = 4096;  // amount of a full cell

}  // namespace

bool Watch::may_find(std::optional<std::int32_t> largest) const {
  return !largest || *largest > std::max(seen_.largest, 2 * kFull);
}

void Watch::look(const state::Volume& volume, std::uint32_t step) {
  seen_.largest = std::max(seen_.largest, 2 * kFull);
  for (int z = 0; z < volume.grid.z; ++z)
    for (std::size_t w = 0; w < volume.solid.row_words(); ++w) {
      std::uint64_t open = ~std::uint64_t{0};  // columns in which nothing blocked has come yet
      for (int y = volume.grid.y - 1; y >= 0 && open != 0; --y) {
        open &= ~(volume.solid.row(y, z)[w] | volume.inert.row(y, z)[w]);
        for (std::uint64_t left = open & volume.liquid.row(y, z)[w]; left != 0; left &= left - 1) {
          const int x = static_cast<int>(64 * w) + std::countr_zero(left);
          const int amount = volume.amount[volume.at(x, y, z)];
          if (amount > seen_.largest) seen_ = {amount, x, y, z, step};
        }
      }
    }
}

std::vector<std::string> Watch::warnings(const run::Simulation& simulation) const {
  std::vector<std::string> found;
  if (seen_.largest > 2 * kFull)
    found.push_back(fmt::format(
        "liquid presses against the top of the grid: cell ({}, {}, {}) held {:.2f} cells at step {}; "
        "a vent brings more than flows away, or the grid is too low",
        seen_.x, seen_.y, seen_.z, seen_.largest / double{kFull}, seen_.step));
  if (const std::int64_t cuts = simulation.irradiance_capped(); cuts > 0)
    found.push_back(fmt::format(
        "irradiance was cut {} time{} (cells at steps of visibility): a cell takes up at most 1/16 of "
        "the range per step; less heat_source.power, or a source farther away, loses nothing",
        cuts, cuts == 1 ? "" : "s"));
  return found;
}

}  // namespace voxmelt::app
