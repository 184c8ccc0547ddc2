#include "hwmodel/pipeline/check/shrink.h"

#include <algorithm>
#include <utility>

namespace voxmelt::hwmodel {

Shrinker::Shrinker(Case begin, std::vector<std::string> removable, Fails fails, std::function<bool()> goes_on)
    : VolumeShrinker(std::move(begin), std::move(fails), std::move(goes_on)),
      removable_(std::move(removable)) {}

const Case& Shrinker::shrink(const std::array<int, 3>& near) {
  shrink_steps();
  crop_around(near);
  crop();
  shrink_steps();
  shrink_machine();
  remove_sources();
  // A simpler machine or fewer sources may allow a smaller grid.
  while (crop()) shrink_machine();
  remove_matter();
  return best();
}

void Shrinker::shrink_steps() {
  for (std::uint32_t steps = 1; steps < best().steps; steps *= 2)
    if (try_change([&](Case& one) { one.steps = steps; })) return;
}

void Shrinker::shrink_machine() {
  const auto attempt = [&](auto member, auto value) {
    if (best().configuration.*member != value)
      try_change([&](Case& one) { one.configuration.*member = value; });
  };
  attempt(&Configuration::stall_seed, std::uint64_t{0});
  attempt(&Configuration::cascade, 1);
  attempt(&Configuration::substeps, 1);
  attempt(&Configuration::fifo_depth, Configuration{}.fifo_depth);
  for (const int lanes : {1, 2, 4, 8})
    if (lanes < best().configuration.lanes) attempt(&Configuration::lanes, lanes);
}

void Shrinker::remove_sources() {
  for (const std::string& name : removable_) {
    const auto& gone = best().without;
    if (std::find(gone.begin(), gone.end(), name) == gone.end())
      try_change([&](Case& one) { one.without.push_back(name); });
  }
}

}  // namespace voxmelt::hwmodel
