#include "app/verify_picture.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <system_error>

#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/verify_report.h"
#include "hwmodel/caster/check/replay_pixel.h"
#include "hwmodel/caster/check/verify_picture.h"
#include "hwmodel/caster/faults/faults.h"
#include "hwmodel/caster/report/report_picture.h"
#include "hwmodel/machine/presets/presets.h"
#include "kernel/run/io/output_folder.h"
#include "render/image/png.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;

// "AZIMUTH,ELEVATION" in degrees.
void set_view(scene::Camera& camera, const std::string& view) {
  const char *begin = view.data(), *end = begin + view.size();
  const auto [comma, bad_azimuth] = std::from_chars(begin, end, camera.azimuth);
  const bool has_comma = bad_azimuth == std::errc() && comma != end && *comma == ',';
  const auto [behind, bad_elevation] = std::from_chars(has_comma ? comma + 1 : end, end, camera.elevation);
  if (!has_comma || bad_elevation != std::errc() || behind != end)
    throw UsageError(fmt::format("error: --view {}: want AZIMUTH,ELEVATION in degrees", view));
}

// "X,Y" or "X,Y,WxH" in pixels.
hwmodel::raycast::Window part_of(const std::string& pixel, const scene::Camera& camera) {
  std::int32_t x = 0, y = 0, wide = 1, high = 1;
  const char *at = pixel.data(), *end = at + pixel.size();
  const auto number = [&](std::int32_t& of) {
    const auto [behind, bad] = std::from_chars(at, end, of);
    at = behind;
    return bad == std::errc();
  };
  const auto sign = [&](char c) { return at != end && *at++ == c; };
  bool good = number(x) && sign(',') && number(y);
  if (good && at != end) good = sign(',') && number(wide) && sign('x') && number(high);
  if (!good || at != end) throw UsageError(fmt::format("error: --pixel {}: want X,Y or X,Y,WxH", pixel));
  if (x < 0 || y < 0 || wide < 1 || high < 1 || x > camera.width - wide || y > camera.height - high)
    throw UsageError(fmt::format("error: --pixel {}: not in a picture of {} x {} pixels", pixel, camera.width,
                                 camera.height));
  return {x, y, x + wide, y + high};
}

// What --pixel says for a part.
std::string text_of(const hwmodel::raycast::Window& part) {
  const std::int32_t wide = part.right - part.left, high = part.bottom - part.top;
  const std::string place = fmt::format("{},{}", part.left, part.top);
  return wide == 1 && high == 1 ? place : fmt::format("{},{}x{}", place, wide, high);
}

hwmodel::raycast::PictureOptions options_of(const PictureChoice& choice,
                                            const hwmodel::raycast::Configuration& configuration,
                                            const hwmodel::raycast::FaultInfo* fault,
                                            const scene::Camera& camera) {
  hwmodel::raycast::PictureOptions options;
  options.configuration = configuration;
  options.compare = choice.compare;
  options.frames = choice.frames;
  if (fault != nullptr) options.fault = fault->fault;
  options.poll = stop_if_interrupted;
  options.waves = !choice.vcd.empty();
  options.waves_from = choice.vcd_from;
  if (!choice.pixel.empty()) options.window = part_of(choice.pixel, camera);
  return options;
}

}  // namespace

void add_picture_choice(Command command, PictureChoice& choice) {
  command.flag("--picture", choice.asked, "verify the ray caster: one picture, after --from steps");
  command.flag("--machine", choice.machine,
               "verify the pipeline and the ray caster on one memory: --steps in all, --frames pictures");
  command.option("--view", choice.view,
                 "with --picture or --machine: the camera's AZIMUTH,ELEVATION in degrees");
  command.option("--size", choice.size, "with --picture: size in pixels, e.g. 256x256");
  command
      .option("--setting", choice.setting,
              "with --picture: samples per pixel: fast 1, normal 1 or 8, best 1 or 32")
      .one_of({"fast", "normal", "best"})
      .shows_default();
  command
      .option("--frames", choice.frames,
              "with --picture: draw it so often; with --machine: pictures of the steps")
      .within(1, 1000)
      .shows_default();
  command.flag("!--no-compare", choice.compare, "with --picture: compare the bytes alone, not every stage");
  command.option("--html", choice.html, "write the report as a page: one HTML file, with pictures");
  command.option("--png", choice.png, "with --picture: write the ray caster's picture");
  command.option("--pixel", choice.pixel,
                 "with --picture: draw only pixel X,Y, or X,Y,WxH: so many from there on");
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')) + '\n'; }

scene::Camera camera_of(const PictureChoice& choice, const scene::Scene& scene) {
  scene::Camera camera = scene.camera;
  if (!choice.size.empty()) set_size(camera, choice.size);
  if (!choice.view.empty()) set_view(camera, choice.view);
  return camera;
}

render::Setting setting_of(const PictureChoice& choice) {
  return choice.setting == "fast"   ? render::Setting::fast
         : choice.setting == "best" ? render::Setting::best
                                    : render::Setting::normal;
}

void check_html_place(const Common& common, const PictureChoice& choice, const std::string& out) {
  check_place("--html", choice.html, out);
  std::error_code none;
  if (!choice.html.empty() && !common.report.empty() &&
      (fs::absolute(choice.html).lexically_normal() == fs::absolute(common.report).lexically_normal() ||
       fs::equivalent(choice.html, common.report, none)))
    throw UsageError(fmt::format("--html {}: error: --report goes to the same file", choice.html));
}

std::string write_waves(const std::string& vcd, std::optional<std::int64_t> from, const std::string& waves) {
  if (vcd.empty()) return {};
  if (waves.empty())
    return fmt::format("--vcd {}: error: the run ended before cycle {}; nothing was written", vcd,
                       from.value_or(0));
  io::write_file(vcd, waves);
  return {};
}

int verify_caster(const Common& common, const PictureChoice& choice, const scene::Scene& scene,
                  const run::Simulation& state, const fs::path& preset,
                  const std::vector<std::string>& hw_sets) {
  const scene::Camera camera = camera_of(choice, scene);
  const render::Setting setting = setting_of(choice);
  const hwmodel::Preset configured = hwmodel::load_preset(preset, hw_sets, hwmodel::Runs::caster);
  const hwmodel::raycast::FaultInfo* fault = hwmodel::raycast::find_fault(choice.plant);
  if (!choice.plant.empty() && fault == nullptr)
    throw UsageError(fmt::format(
        "error: --plant {}: unknown in the ray caster; `voxmelt list faults` names them", choice.plant));
  if (!choice.plant.empty() && !choice.compare)
    throw UsageError("error: --plant: with --no-compare no stage is compared");
  check_report_place(common, "");
  check_html_place(common, choice, "");
  const hwmodel::raycast::PictureOptions options = options_of(choice, configured.caster, fault, camera);
  const hwmodel::raycast::PictureInput input{state.volume(), scene.look, scene.light,
                                             scene.terrain,  camera,     setting};
  const hwmodel::raycast::PictureReport report = hwmodel::raycast::verify_picture(input, options);

  if (fault != nullptr && report.good() && !report.strike)
    throw UsageError(fmt::format(
        "error: --plant {}: in this picture there is nothing that this fault could change", choice.plant));

  if (common.quiet)
    fmt::print("{}: {} cycles\n", scene.name, report.all_cycles);
  else
    fmt::print("{}: step {}, {} x {}, {}; pipes {}, fifo depth {}, stall seed {}\n", scene.name,
               state.step_number(), camera.width, camera.height, choice.setting, options.configuration.pipes,
               options.configuration.fifo_depth, options.configuration.stall_seed);
  if (!common.quiet) fmt::print("{}", hwmodel::raycast::table_of(report, options.configuration));
  fmt::print("{}", common.quiet ? first_line(hwmodel::raycast::verdict_text(report))
                                : hwmodel::raycast::verdict_text(report));
  std::optional<SeenAgain> again;
  const auto replay = hwmodel::raycast::replay_pixel(input, options, report);
  if (replay) {
    const std::string pixel = text_of(replay->part);
    if (!common.quiet)
      fmt::print("{}to see it again:\n  {} --pixel {}\n", hwmodel::raycast::text_of(*replay), choice.again,
                 pixel);
    again = {pixel, replay->fails};
  }
  const std::string no_waves = write_waves(choice.vcd, choice.vcd_from, report.waves);
  write_picture_report({common, choice.html}, {scene.name, camera.width, camera.height}, state.step_number(),
                       report, options.configuration, again);
  if (!choice.png.empty()) render::write_png(choice.png, report.image);
  if (!no_waves.empty() && report.good()) throw UsageError(no_waves);
  if (!no_waves.empty()) say(no_waves);
  return report.good() && !report.strike ? kDone : kCheckFailed;
}

}  // namespace voxmelt::app
