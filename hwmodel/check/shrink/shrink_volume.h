// The search makes a case that fails smaller while it still fails. It serves any machine: it cuts the volume,
// and removes matter from it. A machine's own shrinker simplifies what the machine has beside its volume. The
// caller says what "fails" means.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include "kernel/automaton/state/part.h"

namespace voxmelt::hwmodel::check {

// `Case` has a `volume`, and `from`, the place of the volume in the grid of the scene.
template <class Case>
class VolumeShrinker {
 public:
  using Fails = std::function<bool(const Case&)>;
  // `goes_on` ends the search when it returns false. The best case so far then counts.
  VolumeShrinker(Case begin, Fails fails, std::function<bool()> goes_on)
      : best_(std::move(begin)), fails_(std::move(fails)), goes_on_(std::move(goes_on)) {}

  int tried() const { return tried_; }

 protected:
  const Case& best() const { return best_; }

  // Returns true if the case fails. It is the best one then.
  bool try_case(Case one) {
    if (!goes_on_()) return false;
    ++tried_;
    if (!fails_(one)) return false;
    best_ = std::move(one);
    return true;
  }
  // Tries the best case with one change.
  template <class Change>
  bool try_change(Change&& change) {
    Case one = best_;
    change(one);
    return try_case(std::move(one));
  }

  // Tries small boxes around a cell, with the cell in the middle and at each of their ends.
  void crop_around(const std::array<int, 3>& near) {
    for (const int side : {kSmall, 2 * kSmall}) {
      const std::array<int, 3> all = size();
      std::vector<std::array<int, 3>> begins;
      for (const int at : {side / 2, 1, side - 2})
        for (const int high : {side / 2, 1, side - 2})
          for (const int deep : {side / 2, 1, side - 2}) begins.push_back({at, high, deep});
      for (const std::array<int, 3>& before : begins) {
        state::Box box;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          box.size[axis] = std::min(side, all[axis]);
          box.from[axis] = std::clamp(near[axis] - before[axis], 0, all[axis] - box.size[axis]);
        }
        if (box.size != all && try_box(box)) return;
      }
    }
  }

  // Cuts slabs off the six sides, thick ones first. Returns true if anything could be cut off.
  bool crop() {
    bool any = false;
    for (int slab = longest_side() / 2; slab > 0; slab /= 2)
      for (const std::size_t axis : {1u, 2u, 0u})  // y first: height costs most
        for (const bool low : {false, true})
          while (size()[axis] > slab) {
            state::Box box{{}, size()};
            box.size[axis] -= slab;
            if (low) box.from[axis] = slab;
            if (!try_box(box)) break;
            any = true;
          }
    return any;
  }

  // Turns boxes of matter into air, large ones first.
  void remove_matter() {
    const std::array<int, 3> all = size();
    for (int side = longest_side(); side > 0; side /= 2)
      for (int z = 0; z < all[2]; z += side)
        for (int y = 0; y < all[1]; y += side)
          for (int x = 0; x < all[0]; x += side) {
            const state::Box box{
                {x, y, z},
                {std::min(side, all[0] - x), std::min(side, all[1] - y), std::min(side, all[2] - z)}};
            if (holds_something(best_.volume, box)) try_change([&](Case& one) { clear(one.volume, box); });
          }
  }

 private:
  static constexpr int kSmall = 8;  // cells; side of the smaller boxes that crop_around tries

  std::array<int, 3> size() const {
    const state::Grid& grid = best_.volume.grid;
    return {grid.x, grid.y, grid.z};
  }
  int longest_side() const {
    const std::array<int, 3> all = size();
    return *std::max_element(all.begin(), all.end());
  }
  bool try_box(const state::Box& box) {
    return try_change([&](Case& one) {
      one.volume = state::part_of(best_.volume, box);
      for (std::size_t axis = 0; axis < 3; ++axis) one.from[axis] += box.from[axis];
    });
  }

  Case best_;
  Fails fails_;
  std::function<bool()> goes_on_;
  int tried_ = 0;
};

}  // namespace voxmelt::hwmodel::check
