// Makes a run that fails smaller while it still fails: fewer steps, a part of the grid, a plainer machine,
// fewer sources, less matter. What "fails" means, the caller says.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hwmodel/pipeline/model/pipeline.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

struct Case {
  state::Volume volume;
  std::array<int, 3> from{};  // where it lies in the grid of the scene
  std::uint32_t first_step = 0, steps = 1;
  Configuration configuration;
  std::vector<std::string> without;  // sources and the like that the scene has and this one has not

  std::array<int, 3> size() const { return {volume.grid.x, volume.grid.y, volume.grid.z}; }
};

// The cells of a box; `from` counts in this volume.
state::Volume part_of(const state::Volume& volume, const std::array<int, 3>& from,
                      const std::array<int, 3>& size);

class Shrinker {
 public:
  using Fails = std::function<bool(const Case&)>;
  // `goes_on` ends the search when it gives false: what was found until then counts.
  Shrinker(Case begin, std::vector<std::string> removable, Fails fails, std::function<bool()> goes_on);

  // `near`: the cell of the first difference.
  const Case& shrink(const std::array<int, 3>& near);
  int tried() const { return tried_; }

 private:
  bool try_case(Case one);
  bool try_box(const std::array<int, 3>& from, const std::array<int, 3>& size);
  void shrink_steps();
  void crop_around(const std::array<int, 3>& near);
  bool crop();
  void shrink_machine();
  void remove_sources();
  void remove_matter();

  Case best_;
  std::vector<std::string> removable_;
  Fails fails_;
  std::function<bool()> goes_on_;
  int tried_ = 0;
};

}  // namespace voxmelt::hwmodel
