#include "kernel/run/opening/opening.h"

#include <utility>

#include "kernel/run/trial/fastest.h"

namespace voxmelt::run {

const step::Implementation* implementation_named(const std::string& name) {
  return name == "auto" ? fastest().implementation : implementations().find(name);
}

std::string implementation_names() {
  std::string names = "auto";
  for (const step::Implementation& one : implementations().all()) names += ", " + one.name;
  return names;
}

Simulation begin_run(scene::Scene& scene, const step::Implementation& implementation,
                     const step::Tuning& tuning, std::unique_ptr<visibility::Provider> provider) {
  Simulation simulation(scene.parameters, std::move(scene.initial), implementation, tuning,
                        std::move(provider));
  simulation.begin_at(scene.first_step);
  if (scene.mid_run) simulation.resume(std::move(*scene.mid_run));
  return simulation;
}

}  // namespace voxmelt::run
