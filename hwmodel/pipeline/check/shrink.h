// The shrinker makes a run of the pipeline that fails smaller while it still fails. It tries fewer steps, a
// part of the grid, a simpler machine, fewer sources and less matter.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hwmodel/check/shrink/shrink_volume.h"
#include "hwmodel/pipeline/model/configuration.h"
#include "kernel/automaton/state/volume.h"

namespace voxmelt::hwmodel {

struct Case {
  state::Volume volume;
  std::array<int, 3> from{};  // the place of the volume in the grid of the scene
  std::uint32_t first_step = 0, steps = 1;
  Configuration configuration;
  std::vector<std::string> without;  // sources and the like of the scene that this case leaves out

  std::array<int, 3> size() const { return {volume.grid.x, volume.grid.y, volume.grid.z}; }
};

class Shrinker : public check::VolumeShrinker<Case> {
 public:
  Shrinker(Case begin, std::vector<std::string> removable, Fails fails, std::function<bool()> goes_on);

  // `near` is the cell of the first difference.
  const Case& shrink(const std::array<int, 3>& near);

 private:
  void shrink_steps();
  void shrink_machine();
  void remove_sources();

  std::vector<std::string> removable_;
};

}  // namespace voxmelt::hwmodel
