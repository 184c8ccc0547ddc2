// The example draws a scene while it melts, into the files picture_0.png, picture_1.png and so on.
//   picture SCENE.toml PICTURES STEPS_BETWEEN
#include <voxmelt/voxmelt.h>
#include <cstdlib>
#include <iostream>
#include <string>

int main(int argc, char** argv) try {
  if (argc != 4) return std::cerr << "picture SCENE.toml PICTURES STEPS_BETWEEN\n", 2;
  voxmelt::Simulation simulation(argv[1]);

  voxmelt::Picture picture;
  picture.width = 320;
  picture.height = 240;
  picture.azimuth = 0;
  for (int k = 0; k < std::atoi(argv[2]); ++k) {
    simulation.draw("picture_" + std::to_string(k) + ".png", picture);
    *picture.azimuth += 10;
    simulation.step(std::atoi(argv[3]));
  }
  return 0;
} catch (const voxmelt::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
