// The program `consumer SCENE STEPS` prints the line of `voxmelt digest`, by the library. Half way the run
// goes through a checkpoint, and is drawn.
#include <voxmelt/voxmelt.h>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

int main(int, char** argv) {
  voxmelt::Simulation first(std::filesystem::path(SCENES) / (std::string(argv[1]) + ".toml"));
  const auto steps = static_cast<std::uint32_t>(std::atoi(argv[2]));
  first.step(steps / 2);
  first.save("consumer.vxc");
  voxmelt::Simulation simulation("consumer.vxc");
  const voxmelt::Frame frame = simulation.render();
  if (frame.rgb != first.render().rgb) return 2;
  simulation.step(steps - steps / 2);
  const voxmelt::State state = simulation.state();
  std::printf("step %u digest %016llx mass %s solid %zu liquid %zu\n", simulation.steps_done(),
              static_cast<unsigned long long>(simulation.digest()),
              voxmelt::to_string(simulation.ledgers().mass.held).c_str(), state.solid.count(),
              state.liquid.count());
  return simulation.ledgers().balance() ? 0 : 1;
}
