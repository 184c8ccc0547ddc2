// The example reads the state in place. It prints how much liquid stands above each cell of the ground, as a
// PGM picture.
//   heights SCENE.toml STEPS > heights.pgm
#include <voxmelt/voxmelt.h>
#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <iostream>
#include <vector>

int main(int argc, char** argv) try {
  if (argc != 3) return std::cerr << "heights SCENE.toml STEPS > heights.pgm\n", 2;
  voxmelt::Simulation simulation(argv[1]);
  simulation.step(std::atoi(argv[2]));

  const voxmelt::State state = simulation.state();
  const voxmelt::Grid grid = state.grid;
  std::vector<int> liquid(static_cast<std::size_t>(grid.x) * grid.z);
  for (int z = 0; z < grid.z; ++z)
    for (int y = 0; y < grid.y; ++y) {
      const auto amounts = state.amount.row(y, z);  // a span of grid.x numbers; 4096 is a full cell
      for (int x = 0; x < grid.x; ++x)
        if (state.liquid.test(x, y, z)) liquid[z * grid.x + x] += amounts[x];
    }
  std::cout << "P2 " << grid.x << ' ' << grid.z << " 255\n";
  for (const int amount : liquid) std::cout << std::min(255, amount / 256) << '\n';
  return 0;
} catch (const voxmelt::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
