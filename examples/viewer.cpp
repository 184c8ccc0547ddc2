// The example is the heart of a viewer, without a window. It draws frames from a camera that moves, steps
// until somebody stops it, tells what lies under the pointer, and saves the run.
//   viewer SCENE.toml FRAMES > frames.ppm
#include <voxmelt/voxmelt.h>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <stop_token>

int main(int argc, char** argv) try {
  if (argc != 3) return std::cerr << "viewer SCENE.toml FRAMES > frames.ppm\n", 2;
  voxmelt::Simulation simulation(argv[1]);
  voxmelt::Picture picture;
  picture.camera = simulation.camera();
  picture.width = 320;
  picture.height = 240;
  for (int k = 0; k < std::atoi(argv[2]); ++k) {
    const voxmelt::Frame frame = simulation.render(picture);
    std::cout << "P6 " << frame.width << ' ' << frame.height << " 255\n";
    for (std::size_t y = 0; y < static_cast<std::size_t>(frame.height); ++y)
      std::cout.write(reinterpret_cast<const char*>(frame.rgb.data() + y * frame.stride), 3 * frame.width);
    if (const auto hit = simulation.pick(160, 120, picture))
      std::cerr << "in the middle: cell " << hit->matter.x << ' ' << hit->matter.y << ' ' << hit->matter.z
                << ", " << hit->depth << " cells away\n";
    picture.camera->azimuth += 5;
    picture.camera->distance *= 0.98;

    std::stop_source user;  // stands for a user who presses a key after ten steps
    simulation.step(1000000, user.get_token(), [&](std::uint32_t done, std::uint32_t) {
      if (done == 10) user.request_stop();
    });
  }
  simulation.save("viewer.vxc");
  std::cerr << "at step " << voxmelt::Simulation("viewer.vxc").steps_done() << ", saved\n";
  return 0;
} catch (const voxmelt::Error& error) {
  std::cerr << error.what() << '\n';
  return 2;
}
