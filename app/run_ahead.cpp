#include "app/run_ahead.h"

#include <fmt/format.h>

#include <algorithm>

#include "app/interrupt.h"
#include "app/print.h"

namespace voxmelt::app {

run::Simulation run_ahead(scene::Scene& scene, const Common& common, std::uint32_t from,
                          std::uint32_t steps) {
  const std::uint64_t asked = std::uint64_t{scene.first_step} + from;
  if (asked + steps > 0xFFFFFFFFu)
    throw UsageError(fmt::format("error: --from {}: step numbers end at {}", from, 0xFFFFFFFFu));
  // A checkpoint cannot go back, so it goes on to the next step of visibility.
  const rule::Heat& heat = scene.parameters.heat;
  const std::uint32_t earliest = scene.first_step + (scene.mid_run ? scene.mid_run->steps_done : 0);
  auto until = std::max(static_cast<std::uint32_t>(asked), earliest);
  const std::uint32_t age = heat.visibility_age(until);
  until = !scene.mid_run || until - age >= earliest ? until - age : until - age + heat.visibility_every;
  until = std::max(until, scene.first_step);
  if (!common.quiet && until != asked) print("verifying from step {}, a step of visibility\n", until);
  run::Simulation simulation = make_simulation(scene, common, Steps::of_a_processor);
  if (!common.quiet && simulation.step_number() < until)
    print_error("{} runs to step {}\n", scene.name, until);
  while (simulation.step_number() < until) {
    simulation.step();
    stop_if_interrupted();
  }
  return simulation;
}

}  // namespace voxmelt::app
