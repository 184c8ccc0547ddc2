#include "hwmodel/pipeline/check/shrink.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "kernel/automaton/state/part.h"

namespace voxmelt::hwmodel {
namespace {

constexpr int kSmall = 8;  // cells: no grid is cut below this before everything else was tried

}  // namespace

state::Volume part_of(const state::Volume& volume, const std::array<int, 3>& from,
                      const std::array<int, 3>& size) {
  return state::part_of(volume, {from, size});
}

Shrinker::Shrinker(Case begin, std::vector<std::string> removable, Fails fails, std::function<bool()> goes_on)
    : best_(std::move(begin)),
      removable_(std::move(removable)),
      fails_(std::move(fails)),
      goes_on_(std::move(goes_on)) {}

const Case& Shrinker::shrink(const std::array<int, 3>& near) {
  shrink_steps();
  crop_around(near);
  crop();
  shrink_steps();
  shrink_machine();
  remove_sources();
  // A plainer machine or fewer sources may allow a smaller grid.
  while (crop()) shrink_machine();
  remove_matter();
  return best_;
}

bool Shrinker::try_case(Case one) {
  if (!goes_on_()) return false;
  ++tried_;
  if (!fails_(one)) return false;
  best_ = std::move(one);
  return true;
}

bool Shrinker::try_box(const std::array<int, 3>& from, const std::array<int, 3>& size) {
  Case one = best_;
  one.volume = part_of(best_.volume, from, size);
  for (std::size_t axis = 0; axis < 3; ++axis) one.from[axis] += from[axis];
  return try_case(std::move(one));
}

void Shrinker::shrink_steps() {
  for (std::uint32_t steps = 1; steps < best_.steps; steps *= 2) {
    Case one = best_;
    one.steps = steps;
    if (try_case(std::move(one))) return;
  }
}

// Small boxes around a cell: with the cell in the middle, and at each of their ends.
void Shrinker::crop_around(const std::array<int, 3>& near) {
  for (const int side : {kSmall, 2 * kSmall}) {
    const std::array<int, 3> all = best_.size();
    std::vector<std::array<int, 3>> begins;
    for (const int at : {side / 2, 1, side - 2})
      for (const int high : {side / 2, 1, side - 2})
        for (const int deep : {side / 2, 1, side - 2}) begins.push_back({at, high, deep});
    for (const std::array<int, 3>& before : begins) {
      std::array<int, 3> from{}, size{};
      for (std::size_t axis = 0; axis < 3; ++axis) {
        size[axis] = std::min(side, all[axis]);
        from[axis] = std::clamp(near[axis] - before[axis], 0, all[axis] - size[axis]);
      }
      if (size != all && try_box(from, size)) return;
    }
  }
}

// Cuts slabs off the six sides, thick ones first. True if anything could be cut off.
bool Shrinker::crop() {
  bool any = false;
  const std::array<int, 3> all = best_.size();
  for (int slab = std::max({all[0], all[1], all[2]}) / 2; slab > 0; slab /= 2)
    for (const std::size_t axis : {1u, 2u, 0u})  // where it is high it costs most
      for (const bool low : {false, true})
        while (best_.size()[axis] > slab) {
          std::array<int, 3> from{}, size = best_.size();
          size[axis] -= slab;
          if (low) from[axis] = slab;
          if (!try_box(from, size)) break;
          any = true;
        }
  return any;
}

void Shrinker::shrink_machine() {
  const auto attempt = [&](auto member, auto value) {
    if (best_.configuration.*member == value) return;
    Case one = best_;
    one.configuration.*member = value;
    try_case(std::move(one));
  };
  attempt(&Configuration::stall_seed, std::uint64_t{0});
  attempt(&Configuration::cascade, 1);
  attempt(&Configuration::substeps, 1);
  attempt(&Configuration::fifo_depth, Configuration{}.fifo_depth);
  for (const int lanes : {1, 2, 4, 8})
    if (lanes < best_.configuration.lanes) attempt(&Configuration::lanes, lanes);
}

void Shrinker::remove_sources() {
  for (const std::string& name : removable_) {
    if (std::find(best_.without.begin(), best_.without.end(), name) != best_.without.end()) continue;
    Case one = best_;
    one.without.push_back(name);
    try_case(std::move(one));
  }
}

// Boxes of matter become air, large ones first.
void Shrinker::remove_matter() {
  const std::array<int, 3> all = best_.size();
  for (int side = std::max({all[0], all[1], all[2]}); side > 0; side /= 2)
    for (int z = 0; z < all[2]; z += side)
      for (int y = 0; y < all[1]; y += side)
        for (int x = 0; x < all[0]; x += side) {
          const std::array<int, 3> from{x, y, z};
          const std::array<int, 3> size{std::min(side, all[0] - x), std::min(side, all[1] - y),
                                        std::min(side, all[2] - z)};
          if (!holds_something(best_.volume, {from, size})) continue;
          Case one = best_;
          clear(one.volume, {from, size});
          try_case(std::move(one));
        }
}

}  // namespace voxmelt::hwmodel
