// consumer SCENE STEPS: the line that `voxmelt digest` prints, by the library.
#include <voxmelt/voxmelt.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

int main(int, char** argv) {
  voxmelt::Simulation simulation(std::filesystem::path(SCENES) / (std::string(argv[1]) + ".toml"));
  simulation.step(static_cast<std::uint32_t>(std::atoi(argv[2])));
  const voxmelt::State state = simulation.state();
  std::printf("step %u digest %016llx mass %s solid %zu liquid %zu\n", simulation.steps_done(),
              static_cast<unsigned long long>(simulation.digest()),
              voxmelt::to_string(simulation.ledgers().mass.held).c_str(), state.solid.count(),
              state.liquid.count());
  return simulation.ledgers().balance() ? 0 : 1;
}
