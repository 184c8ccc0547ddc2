// The command `voxmelt render` draws one picture, or a turntable.
#include <fmt/format.h>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <system_error>
#include <utility>

#include "app/beginning.h"
#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/progress.h"
#include "app/report.h"
#include "app/run_journal.h"
#include "app/surface_pictures.h"
#include "app/visibility.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/scene/text/ascii.h"
#include "render/device/picture_on_device.h"
#include "render/image/png.h"
#include "render/packet/picture.h"
#include "render/packet/scene_in_integers.h"
#include "render/reference/print_trace.h"
#include "render/rule/camera.h"

namespace voxmelt::app {
namespace {

struct RenderOptions {
  Common common;
  std::uint32_t steps = 0;
  std::string out, setting = "normal";
  std::optional<std::string> size;
  std::string depth, normals;        // files; empty for none
  std::optional<std::string> trace;  // X,Y
  std::optional<double> azimuth, elevation;
  int turntable = 0;
};

using Draw = std::function<render::Image(const scene::Camera&)>;

struct Pixel {
  int x = 0, y = 0;
};

// Reads "X,Y", counted from the upper left corner of the picture.
Pixel pixel_of(const std::string& text, const scene::Camera& camera) {
  Pixel at;
  const char *begin = text.data(), *end = begin + text.size();
  const auto [comma, bad_x] = std::from_chars(begin, end, at.x);
  const bool has_comma = bad_x == std::errc() && comma != end && *comma == ',';
  const auto [behind, bad_y] = std::from_chars(has_comma ? comma + 1 : end, end, at.y);
  if (!has_comma || bad_y != std::errc() || behind != end || at.x < 0 || at.y < 0 || at.x >= camera.width ||
      at.y >= camera.height)
    throw UsageError(fmt::format("--trace {}: error: not a pixel X,Y from 0,0 to {},{}", text,
                                 camera.width - 1, camera.height - 1));
  return at;
}

// Writes depth and normals, if they are wanted. Returns the text to print about them.
std::string write_surface(const RenderOptions& options, const render::Picture& picture,
                          const scene::Camera& camera, render::Setting setting) {
  if (options.depth.empty() && options.normals.empty()) return {};
  const SurfacePictures pictures = surface_pictures(picture, camera, setting, thread_count(options.common));
  std::string text;
  if (!options.depth.empty()) {
    render::write_png(options.depth, pictures.depth);
    text += fmt::format("written: {}  in 1/32 cells from {} cells before the eye\n", options.depth,
                        pictures.near);
  }
  if (!options.normals.empty()) {
    render::write_png(options.normals, pictures.normals);
    text += fmt::format("written: {}\n", options.normals);
  }
  return text;
}

std::string suffix_of(const std::string& file) {
  std::string suffix = std::filesystem::path(file).extension().string();
  for (char& c : suffix) c = scene::lower_case(c);
  return suffix;
}

// Refuses a picture's name that promises another kind of picture.
void check_is_png(const std::string& option, const std::string& file) {
  const std::string suffix = suffix_of(file);
  if (!file.empty() && !suffix.empty() && suffix != ".png")
    throw UsageError(
        fmt::format("{} {}: error: pictures are written as PNG, not as {}", option, file, suffix));
}

// Refuses the name of a picture or a film for a folder of views: the user would look for such a file.
void check_is_folder(const std::string& file) {
  for (const char* const suffix : {".png", ".jpg", ".jpeg", ".gif", ".webp", ".mp4"})
    if (suffix_of(file) == suffix)
      throw UsageError(fmt::format(
          "--out {}: error: --turntable writes its views into a folder, and {} is no folder's name", file,
          suffix));
}

// Checks that the outputs are possible, and chooses the names that were left open.
void settle_outputs(RenderOptions& options) {
  if (options.out.empty()) options.out = options.turntable > 0 ? "turntable" : "picture.png";
  if (options.turntable == 0)
    check_is_png("--out", options.out);
  else
    check_is_folder(options.out);
  check_is_png("--depth", options.depth);
  check_is_png("--normals", options.normals);
}

scene::Scene load_view(const RenderOptions& options) {
  scene::Scene scene = load_scene(options.common);
  keep_inputs(scene, {{"--out", options.out},
                      {"--depth", options.depth},
                      {"--normals", options.normals},
                      {"--report", options.common.report}});
  check_steps(scene, options.steps);
  if (options.size) set_size(scene.camera, *options.size);
  if (options.azimuth) scene.camera.azimuth = *options.azimuth;
  if (options.elevation) scene.camera.elevation = *options.elevation;
  if (options.turntable > 0 && !(options.depth.empty() && options.normals.empty()))
    throw UsageError("--turntable: error: --depth and --normals are of one picture");
  return scene;
}

void run_to(scene::Scene& scene, run::Simulation& simulation, const RenderOptions& options) {
  RunJournal journal(scene, simulation);
  Progress progress(options.steps, options.common.quiet);
  while (simulation.steps_done() < options.steps) {
    journal.apply();
    simulation.step();
    stop_if_interrupted();
    progress.show(simulation.steps_done(), simulation);
  }
}

// Draws one picture, and then writes the report that `report()` gives. Depth and normals are of `picture`.
template <class Report>
void write_picture(const RenderOptions& options, const Draw& draw, const render::Picture* picture,
                   const scene::Camera& camera, render::Setting setting, const Report& report) {
  render::write_png(options.out, draw(camera));
  const std::string near =
      picture != nullptr ? write_surface(options, *picture, camera, setting) : std::string();
  if (!options.common.quiet) print("written: {}\n{}", options.out, near);
  write_report(options.common, report());
}

// Draws a turntable into `out`. If a view cannot be written, the earlier ones are kept.
template <class Report>
void write_turntable(const RenderOptions& options, io::OutputFolder& out, const Draw& draw,
                     scene::Camera camera, const Report& report) {
  int made = 0;
  try {
    for (; made < options.turntable; ++made) {
      stop_if_interrupted();
      render::write_png(out.partial() / fmt::format("view_{:03d}.png", made), draw(camera));
      camera.azimuth += 360.0 / options.turntable;
    }
    out.commit();
  } catch (const Interrupted&) {
    throw;
  } catch (const render::Stopped&) {
    throw;
  } catch (...) {
    if (made == 0) throw;
    out.release_reserve();
    say(fmt::format("{} of {} views are kept in {}/", made, options.turntable,
                    seen_from_here(out.keep_incomplete())));
    throw;
  }
  if (!options.common.quiet) print("{} views written to {}\n", options.turntable, options.out);
  write_report(options.common, report());
}

// Draws a state on the device that has it, or on the host, with the same bytes.
class Drawn {
  // Counts as drawing on a device, if that succeeds.
  template <class Work>
  auto timed(const Work& work) {
    const auto begin = std::chrono::steady_clock::now();
    auto result = work();
    if (result)
      seconds_.on_device += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    return result;
  }

 public:
  Drawn(const RenderOptions& options, const scene::Scene& scene, const run::Simulation& simulation,
        render::Setting setting)
      : options_(options), scene_(scene), simulation_(simulation), setting_(setting) {
    if (wants_host()) update_host();
    if (picture_ == nullptr && !timed([&] {
          return on_device_.update(simulation.state_on_device(), scene.look, scene.light, scene.terrain);
        }))
      update_host();
  }

  // A device's picture is none of a camera that may stand inside.
  bool camera_inside() const { return picture_ != nullptr && picture_->camera_inside(scene_.camera); }
  const render::Picture* of_host() const { return picture_.get(); }
  RunSeconds seconds() const { return seconds_; }

  render::Image draw(const scene::Camera& camera) {
    if (picture_ == nullptr) {
      if (auto image = timed([&] { return on_device_.draw(camera, setting_); })) return std::move(*image);
      update_host();  // the device has failed
    }
    return picture_->draw(camera, setting_, thread_count(options_.common));
  }

 private:
  // Depth and normals are the host's, and so is the question where the camera stands.
  bool wants_host() const {
    const state::Grid& grid = scene_.initial.grid;
    return !options_.depth.empty() || !options_.normals.empty() ||
           picture::view_of(render::camera_in_integers(scene_.camera), {grid.x, grid.y, grid.z}).near <= 0;
  }
  void update_host() {
    picture_ = std::make_unique<render::Picture>();
    picture_->stop_when(interrupted);
    picture_->update(simulation_.volume(), scene_.look, scene_.light, scene_.terrain,
                     thread_count(options_.common));
  }
  const RenderOptions& options_;
  const scene::Scene& scene_;
  const run::Simulation& simulation_;
  const render::Setting setting_;
  std::unique_ptr<render::Picture> picture_;  // of the host, if that draws
  render::PictureOnDevice on_device_;
  RunSeconds seconds_;
};

int run_render(RenderOptions options) {
  settle_outputs(options);
  scene::Scene scene = load_view(options);
  const Pixel traced = options.trace ? pixel_of(*options.trace, scene.camera) : Pixel{};
  check_report_place(options.common, options.turntable > 0 ? options.out : "");
  for (const auto& [option, file] :
       {std::pair("--depth", options.depth), std::pair("--normals", options.normals)})
    check_place(option, file, "");
  catch_interrupts();
  std::optional<io::OutputFolder> out;
  if (options.turntable > 0 && !options.trace)
    out.emplace(options.out);
  else if (!options.trace)
    check_place("--out", options.out, "");

  run::Simulation simulation = make_simulation(scene, options.common);
  run_to(scene, simulation, options);
  warn_of_limit(scene, options.common, simulation);
  const render::Setting setting = setting_of(options.setting);
  if (options.trace) {
    render::print_trace(std::cout, simulation.volume(), scene.look, scene.light, scene.terrain, scene.camera,
                        setting, traced.x, traced.y);
    write_report(options.common, report_json(scene, options.common, simulation, {}));
    return kDone;
  }
  Drawn drawn(options, scene, simulation, setting);
  if (drawn.camera_inside())
    warn(scene, options.common, {"the camera stands in matter or in the ground, and sees nothing else"});
  const Draw draw = [&](const scene::Camera& camera) { return drawn.draw(camera); };
  const auto report = [&] { return report_json(scene, options.common, simulation, drawn.seconds()); };
  if (out)
    write_turntable(options, *out, draw, scene.camera, report);
  else
    write_picture(options, draw, drawn.of_host(), scene.camera, setting, report);
  return kDone;
}

}  // namespace

void add_render(CommandLine& program) {
  auto options = std::make_shared<RenderOptions>();
  const Command command = program.add("render", "Draw the state after N steps: one picture, or a turntable");
  add_scene(command, options->common);
  command.option("--steps", options->steps, "steps to run first").shows_default();
  const Option out = command.option("--out", options->out,
                                    "file to write (default: picture.png), or folder (default: turntable)");
  command.option("--size", options->size, "size in pixels, e.g. 1280x960");
  const Option depth =
      command.option("--depth", options->depth, "also write how far the surface is (PNG, 16 bits)");
  const Option normals =
      command.option("--normals", options->normals, "also write where the surface faces (PNG, 3 x 16 bits)");
  add_setting(command, options->setting);
  command.option("--azimuth", options->azimuth, "degrees around the vertical, instead of the scene's")
      .within(-360.0, 360.0);
  command.option("--elevation", options->elevation, "degrees above the horizon, instead of the scene's")
      .within(-89.0, 89.0);
  const Option turntable =
      command
          .option("--turntable", options->turntable,
                  "this many views around the scene, into the folder --out (a name without .png)")
          .within(1, 3600);
  command
      .option("--trace", options->trace,
              "print all numbers of pixel X,Y, from the upper left, instead of drawing")
      .excludes(out)
      .excludes(turntable)
      .excludes(depth)
      .excludes(normals);
  add_common(command, options->common);
  add_visibility(command, options->common);
  command.runs([options] { return run_render(*options); });
}

}  // namespace voxmelt::app
