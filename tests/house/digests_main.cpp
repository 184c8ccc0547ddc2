// The program `digests_main SCENES IMPLEMENTATION STEPS NAME...` prints the digest of each scene after STEPS
// steps. It is for machines on which no more of the program than kernel/ is built.
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "kernel/automaton/state/digest.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"

using namespace voxmelt;

int main(int argc, char** argv) {
  const step::Implementation* implementation = argc > 4 ? run::implementations().find(argv[2]) : nullptr;
  if (implementation == nullptr) return 2;
  for (int i = 4; i < argc; ++i) {
    const scene::Scene scene =
        scene::load(std::filesystem::path(argv[1]) / (std::string(argv[i]) + ".toml"), {});
    run::Simulation simulation(scene.parameters, scene.initial, *implementation);
    for (int step = 0; step < std::atoi(argv[3]); ++step) simulation.step();
    std::printf("%s %016" PRIx64 "\n", argv[i], state::digest(simulation.volume()));
  }
}
