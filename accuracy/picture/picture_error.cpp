// The program picture_error tells how far pictures are from the converged one
// (docs/results/picture-error.md).
//
//   picture_error [--scenes cello,goblet] [--views 20] [--size 256] [--threads 2] [--causes] [--out FOLDER]
//
// It prints a line of comma-separated values per picture, and a summary to the other stream. With --out it
// writes the worst picture of each setting, the converged one and their difference.
#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "accuracy/picture/compare.h"
#include "accuracy/picture/exact_picture.h"
#include "accuracy/picture/integer_pixels.h"
#include "accuracy/picture/sampling.h"
#include "kernel/run/simulation.h"
#include "kernel/scene/scene.h"
#include "render/density/density_field.h"
#include "render/image/png.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/picture_scene.h"

namespace voxmelt::accuracy {
namespace {

struct MidMelt {
  const char* scene;
  std::uint32_t steps;
};
constexpr MidMelt kScenes[] = {{"cello", 300},        {"goblet", 300}, {"lava", 600},
                               {"lava_viscous", 400}, {"bunny", 400},  {"proving_ground", 60}};
constexpr int kViews = 20;
constexpr double kElevations[] = {16, -25, 40, 3, 70};

class UsageError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct Options {
  std::vector<std::string> scenes;  // all if empty
  int views = kViews, size = 256, threads = 2;
  bool causes = false;
  std::string out;
};

int number(std::string_view name, std::string_view text, int low, int high) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value < low || value > high)
    throw UsageError(std::string(name) + ": " + std::string(text) + " is not a number from " +
                     std::to_string(low) + " to " + std::to_string(high));
  return value;
}

Options options_of(const std::vector<std::string>& arguments) {
  Options options;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& name = arguments[i];
    const auto value = [&]() -> const std::string& {
      if (i + 1 == arguments.size()) throw UsageError(name + " wants a value");
      return arguments[++i];
    };
    if (name == "--causes") {
      options.causes = true;
    } else if (name == "--scenes") {
      std::stringstream names(value());
      for (std::string one; std::getline(names, one, ',');) options.scenes.push_back(one);
    } else if (name == "--out") {
      options.out = value();
    } else if (name == "--views") {
      options.views = number(name, value(), 1, kViews);
    } else if (name == "--size") {
      options.size = number(name, value(), 8, 4096);
    } else if (name == "--threads") {
      options.threads = number(name, value(), 1, 256);
    } else {
      throw UsageError(name + ": unknown; see the head of accuracy/picture/picture_error.cpp");
    }
  }
  for (const std::string& name : options.scenes)
    if (std::none_of(std::begin(kScenes), std::end(kScenes),
                     [&](const MidMelt& s) { return name == s.scene; }))
      throw UsageError("--scenes: no scene " + name + " here");
  return options;
}

// Returns view k of a turntable. Views that follow each other are far apart, so that the first few show all
// sides.
scene::Camera camera_of(scene::Camera camera, int view, int size) {
  camera.azimuth += 360.0 * (view * 7 % kViews) / kViews;
  camera.elevation = kElevations[view % 5];
  camera.width = camera.height = size;
  return camera;
}

struct Drawing {
  std::string name;
  int spacing;  // spacing of the integers; negative: drawn without roundings and steps
  Sampling sampling;
  double one = picture::kPixel;  // units of a sample's place to a pixel
};

std::vector<Drawing> drawings(bool causes) {
  std::vector<Drawing> all;
  const auto step = [](int spacing) { return "1/" + std::to_string(1 << spacing); };
  for (const int spacing : {1, 2, 3}) {
    all.push_back({"fast " + step(spacing), spacing, fast_sampling()});
    all.push_back({"normal " + step(spacing), spacing, normal_sampling()});
    all.push_back({"best " + step(spacing), spacing, best_sampling()});
  }
  if (!causes) return all;
  // Without roundings and steps, only the number and the places of the samples cost.
  all.push_back({"fast exact", -1, fast_sampling()});
  all.push_back({"normal exact", -1, normal_sampling()});
  all.push_back({"best exact", -1, best_sampling()});
  // With as many samples as the converged picture, only roundings and steps cost.
  for (const int spacing : {2, 3})
    all.push_back({"64 samples " + step(spacing), spacing, lattice_sampling()});
  for (const int most : {4, 8, 32})
    all.push_back({"eight where >" + std::to_string(most), -1, normal_sampling(most)});
  for (const int most : {3, 16})
    all.push_back({"thirty-two where >" + std::to_string(most), -1, best_sampling(most)});
  return all;
}

struct Worst {
  double error = 1e9;
  std::string view;
  render::Image drawn, converged;
};

void measure(const MidMelt& which, const Options& options, std::map<std::string, Worst>& worst) {
  scene::Scene scene =
      scene::load(std::filesystem::path(VOXMELT_SCENES_FOLDER) / (std::string(which.scene) + ".toml"),
                  {"pieces.fall=false"});  // as docs/results has it
  run::Simulation simulation(scene.parameters, std::move(scene.initial), run::implementations().widest());
  while (simulation.steps_done() < which.steps) simulation.step();
  render::DensityField density;
  density.update(simulation.volume(), scene.look, scene.terrain, options.threads);
  const render::PictureScene data(density, scene.look, scene.light, scene.terrain);
  const ExactScene exact(data);
  cpu::Workers workers(options.threads);

  for (int view = 0; view < options.views; ++view) {
    const scene::Camera asked = camera_of(scene.camera, view, options.size);
    picture::Camera camera = render::camera_in_integers(asked);
    if (camera.distance == 0) {  // both pictures take the distance that fits as given
      const picture::Vector back = picture::view_of(camera, data.levels.cells()).eye - camera.target;
      camera.distance = std::llround(std::sqrt(dot(accuracy::exact(back, 256), accuracy::exact(back, 256))));
    }
    const ExactPicture picture(exact, camera, data.levels.cells());
    const render::Image converged = picture.draw(workers);
    for (const Drawing& drawing : drawings(options.causes)) {
      const IntegerPixels integers(data, exact.field, camera, std::max(drawing.spacing, 0));
      const Sampled drawn = sampled(
          options.size, options.size, drawing.sampling,
          [&](int x, int y, Places places) {
            return drawing.spacing < 0 ? picture.pixel(x, y, places, drawing.one)
                                       : integers.pixel(x, y, places);
          },
          workers);
      const double error = psnr(drawn.image, converged);
      std::printf("%s,%d,%.0f,%.0f,%s,%.3f,%.3f\n", which.scene, view, asked.azimuth, asked.elevation,
                  drawing.name.c_str(), error, drawn.samples);
      Worst& least = worst[drawing.name];
      if (error < least.error)
        least = {error, std::string(which.scene) + " view " + std::to_string(view), drawn.image, converged};
    }
    std::fflush(stdout);
  }
}

int run(const Options& options) {
  std::map<std::string, Worst> worst;
  std::printf("scene,view,azimuth,elevation,drawing,db,samples\n");
  for (const MidMelt& scene : kScenes)
    if (options.scenes.empty() ||
        std::find(options.scenes.begin(), options.scenes.end(), scene.scene) != options.scenes.end())
      measure(scene, options, worst);
  for (const auto& [name, error] : worst)
    std::fprintf(stderr, "%-24s worst %.2f dB, %s\n", name.c_str(), error.error, error.view.c_str());
  if (options.out.empty()) return 0;
  const std::filesystem::path folder = options.out;
  std::filesystem::create_directories(folder);
  for (const auto& [drawing, setting] :
       {std::pair{"fast 1/4", "fast"}, {"normal 1/4", "normal"}, {"best 1/8", "best"}}) {
    const Worst& the_worst = worst[drawing];
    render::write_png(folder / (std::string(setting) + "_drawn.png"), the_worst.drawn);
    render::write_png(folder / (std::string(setting) + "_converged.png"), the_worst.converged);
    render::write_png(folder / (std::string(setting) + "_difference.png"),
                      difference_picture(the_worst.drawn, the_worst.converged));
  }
  return 0;
}

}  // namespace
}  // namespace voxmelt::accuracy

int main(int argc, char** argv) {
  using namespace voxmelt::accuracy;
  try {
    return run(options_of(std::vector<std::string>(argv + 1, argv + argc)));
  } catch (const UsageError& error) {
    std::fprintf(stderr, "picture_error: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "picture_error: %s\n", error.what());
    return 1;
  }
}
