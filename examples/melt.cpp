// The example melts a scene and prints the digest of its state. Equal digests mean equal bits.
//   melt SCENE.toml STEPS
#include <voxmelt/voxmelt.h>
#include <cstdlib>
#include <ios>
#include <iostream>

int main(int argc, char** argv) try {
  if (argc != 3) return std::cerr << "melt SCENE.toml STEPS\n", 2;
  voxmelt::Simulation simulation(argv[1]);
  simulation.step(std::atoi(argv[2]));

  std::cout << simulation.title() << "\nstep " << std::dec << simulation.steps_done() << " digest "
            << std::hex << simulation.digest() << '\n';
  return simulation.ledgers().balance() ? 0 : 1;
} catch (const voxmelt::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
