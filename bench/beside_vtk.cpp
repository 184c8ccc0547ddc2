// The program beside_vtk is voxmelt's half of bench/compare_vtk.py.
//
//   beside_vtk SCENE FIELD_FILE
//
// It melts a scene to the middle of its melt and writes the field that is drawn: 16 bits a cell, x fastest.
// It prints a line of JSON with grid, camera and voxmelt's errors. For every line that comes in, it draws,
// and prints a line with the least milliseconds so far, on one thread.
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <ios>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "accuracy/picture/compare.h"
#include "accuracy/picture/exact_picture.h"
#include "accuracy/picture/sampling.h"
#include "measure/clocks.h"
#include "measure/drawing.h"
#include "render/density/density_field.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"

namespace voxmelt {
namespace {

constexpr int kThreads = 2;  // for work that is not timed
constexpr render::Setting kTimed[] = {render::Setting::fast, render::Setting::normal};

struct Drawn {
  explicit Drawn(const std::string& name)
      : scene(scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (name + ".toml"), {})),
        camera(measure::square_camera(scene.camera, measure::kPictureSide)) {
    if (camera.distance == 0) throw std::runtime_error(name + ": its camera has no distance");
    const std::uint32_t middle = measure::middle_of(name);
    if (middle == 0) throw std::runtime_error(name + ": the middle of its melt is not known");
    field.update(measure::scene_at(scene, middle, kThreads).start, scene.look, scene.terrain, kThreads);
    picture.update(field, scene.look, scene.light, scene.terrain, nullptr, kThreads);
  }
  render::Image draw(render::Setting setting, const render::Packets& packets) const {
    return picture.draw(camera, setting, 1, packets);
  }

  scene::Scene scene;
  scene::Camera camera;
  render::DensityField field;
  render::Picture picture;
};

// Returns the errors against the picture of the same definition in double with the same samples. They are the
// cost of steps and roundings.
std::vector<double> errors(const Drawn& drawn) {
  const render::PictureScene data(drawn.field, drawn.scene.look, drawn.scene.light, drawn.scene.terrain);
  const accuracy::ExactScene scene(data);
  const accuracy::ExactPicture exact(scene, render::camera_in_integers(drawn.camera), data.levels.cells());
  cpu::Workers workers(kThreads);
  std::vector<double> all;
  for (const render::Setting setting : kTimed) {
    const accuracy::Sampled converged = accuracy::sampled(
        measure::kPictureSide, measure::kPictureSide,
        setting == render::Setting::fast ? accuracy::fast_sampling() : accuracy::normal_sampling(),
        [&](int x, int y, accuracy::Places places) { return exact.pixel(x, y, places); }, workers);
    all.push_back(accuracy::psnr(drawn.draw(setting, render::best_packets()), converged.image));
  }
  return all;
}

void write_field(const Drawn& drawn, const std::string& file) {
  const auto& values = drawn.field.intensity();
  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(values.data()), drawn.field.grid().cells() * sizeof(std::uint16_t));
  if (!out.flush()) throw std::runtime_error("cannot write " + file);
}

void print_scene(const Drawn& drawn) {
  const state::Grid& grid = drawn.field.grid();
  const picture::View view =
      picture::view_of(render::camera_in_integers(drawn.camera), {grid.x, grid.y, grid.z});
  const auto vector = [](picture::Vector the_vector, double one) {
    std::printf("[%.6f, %.6f, %.6f]", static_cast<double>(the_vector.x) / one,
                static_cast<double>(the_vector.y) / one, static_cast<double>(the_vector.z) / one);
  };
  std::printf("{\"grid\": [%d, %d, %d], \"side\": %d, \"view_angle\": %.6f, \"full\": %d, \"eye\": ", grid.x,
              grid.y, grid.z, measure::kPictureSide, drawn.camera.field_of_view, render::kFull);
  vector(view.eye, picture::kCell);
  std::printf(", \"forward\": ");
  vector(view.forward, picture::kUnit);
  std::printf(", \"up\": ");
  vector(view.up, picture::kUnit);
  const scene::Vec3& solid = drawn.scene.look.solid;
  const std::vector<double> db = errors(drawn);
  std::printf(", \"color\": [%.3f, %.3f, %.3f], \"db\": {\"fast\": %.3f, \"normal\": %.3f}}\n", solid[0],
              solid[1], solid[2], db[0], db[1]);
  std::fflush(stdout);
}

struct Timed {
  measure::Drawer drawer;
  measure::Least least[2];
};

void run(const std::string& scene, const std::string& file) {
  const Drawn drawn(scene);
  write_field(drawn, file);
  print_scene(drawn);
  std::vector<Timed> all;
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
    if (row.supported()) all.push_back({measure::drawer_of(row.set), {}});
  for (std::string line; std::getline(std::cin, line);) {
    for (int i = 0; i < 5; ++i)
      for (Timed& one : all)
        for (std::size_t s = 0; s < 2; ++s)
          one.least[s].add(measure::seconds_for(measure::Clock::thread,
                                                [&] { drawn.draw(kTimed[s], *one.drawer.packets); }));
    std::printf("{");
    for (const Timed& one : all)
      std::printf("%s\"%s\": {\"fast\": %.6f, \"normal\": %.6f}", &one == all.data() ? "" : ", ",
                  std::string(cpu::name_of(one.drawer.set)).c_str(), 1e3 * one.least[0].value(),
                  1e3 * one.least[1].value());
    std::printf("}\n");
    std::fflush(stdout);
  }
}

}  // namespace
}  // namespace voxmelt

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: beside_vtk SCENE FIELD_FILE\n");
    return 2;
  }
  try {
    voxmelt::run(argv[1], argv[2]);
  } catch (const voxmelt::scene::InputError& error) {
    std::fprintf(stderr, "beside_vtk: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "beside_vtk: %s\n", error.what());
    return 1;
  }
  return 0;
}
