#include "app/verify_picture.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdint>
#include <filesystem>
#include <system_error>

#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/print.h"
#include "app/verify_command.h"
#include "app/verify_report.h"
#include "app/verify_shrink.h"
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

// Reads "AZIMUTH,ELEVATION" in degrees.
void set_view(scene::Camera& camera, const std::string& view) {
  const char *begin = view.data(), *end = begin + view.size();
  const auto [comma, bad_azimuth] = std::from_chars(begin, end, camera.azimuth);
  const bool has_comma = bad_azimuth == std::errc() && comma != end && *comma == ',';
  const auto [behind, bad_elevation] = std::from_chars(has_comma ? comma + 1 : end, end, camera.elevation);
  if (!has_comma || bad_elevation != std::errc() || behind != end)
    throw UsageError(fmt::format("error: --view {}: want AZIMUTH,ELEVATION in degrees", view));
}

// Reads "X,Y" or "X,Y,WxH" in pixels.
hwmodel::raycast::Window part_of(const std::string& pixel, const scene::Camera& camera) {
  std::int32_t x = 0, y = 0, wide = 1, high = 1;
  const char *at = pixel.data(), *end = at + pixel.size();
  const auto number = [&](std::int32_t& value) {
    const auto [behind, bad] = std::from_chars(at, end, value);
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

hwmodel::raycast::PictureOptions options_of(const VerifyCommand& command,
                                            const hwmodel::raycast::Configuration& configuration,
                                            const hwmodel::raycast::FaultInfo* fault,
                                            const scene::Camera& camera) {
  const PictureChoice& choice = command.picture;
  hwmodel::raycast::PictureOptions options;
  options.configuration = configuration;
  options.compare = choice.compare;
  options.frames = choice.frames;
  if (fault != nullptr) options.fault = fault->fault;
  options.poll = stop_if_interrupted;
  options.waves = !command.vcd.empty();
  options.waves_from = command.vcd_from;
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
  add_setting(command, choice.setting, "with --picture: ");
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

namespace {

void check_picture(const VerifyCommand& command, const scene::Scene& scene) {
  const PictureChoice& choice = command.picture;
  if (!command.plant.empty() && hwmodel::raycast::find_fault(command.plant) == nullptr)
    throw UsageError(fmt::format(
        "error: --plant {}: unknown in the ray caster; `voxmelt list faults` names them", command.plant));
  if (!command.plant.empty() && !choice.compare)
    throw UsageError("error: --plant: with --no-compare no stage is compared");
  check_report_place(command.common, "");
  check_html_place(command.common, choice, "");
  check_place("--vcd", command.vcd, "");
  check_place("--shrink", command.shrink, "");
  keep_inputs(scene, {{"--html", choice.html}, {"--vcd", command.vcd}, {"--shrink", command.shrink}});
}

struct PictureRun {
  const VerifyCommand& command;
  const scene::Scene& scene;
  const hwmodel::raycast::PictureInput& input;
  const hwmodel::raycast::PictureOptions& options;
  const hwmodel::raycast::PictureReport& report;
  std::uint32_t step = 0;
};

void print_picture(const PictureRun& drawn) {
  const auto& [command, scene, input, options, report, step] = drawn;
  if (command.common.quiet) {
    print("{}: {} cycles\n{}", scene.name, report.all_cycles,
          first_line(hwmodel::raycast::verdict_text(report)));
    return;
  }
  print("{}: step {}, {} x {}, {}; pipes {}, fifo depth {}, stall seed {}\n", scene.name, step,
        input.camera.width, input.camera.height, command.picture.setting, options.configuration.pipes,
        options.configuration.fifo_depth, options.configuration.stall_seed);
  print("{}{}", hwmodel::raycast::table_of(report, options.configuration),
        hwmodel::raycast::verdict_text(report));
}

std::optional<SeenAgain> see_again(const PictureRun& drawn) {
  const auto& [command, scene, input, options, report, step] = drawn;
  const auto replay = hwmodel::raycast::replay_pixel(input, options, report);
  if (!replay) return {};
  const std::string pixel = hwmodel::raycast::pixel_text(replay->part);
  if (!command.common.quiet)
    print("{}to see it again:\n  {} --pixel {}\n", hwmodel::raycast::text_of(*replay),
          picture_again(command, scene.file.string()), pixel);
  return SeenAgain{pixel, replay->fails};
}

void write_outputs(const PictureRun& drawn, const std::optional<SeenAgain>& again) {
  const auto& [command, scene, input, options, report, step] = drawn;
  const PictureChoice& choice = command.picture;
  write_picture_report({command.common, choice.html}, {scene.name, input.camera.width, input.camera.height},
                       step, report, options.configuration, again);
  if (!choice.png.empty()) render::write_png(choice.png, report.image);
}

void shrink(const PictureRun& drawn) {
  const VerifyCommand& command = drawn.command;
  if (command.shrink.empty()) return;
  if (drawn.report.good()) {
    if (!command.common.quiet) print("--shrink: there is no difference to make small\n");
    return;
  }
  try_writing([&] {
    const std::string small =
        make_small_picture(command, drawn.scene, drawn.input, drawn.options, drawn.report);
    if (!command.common.quiet) print("{}", small);
  });
}

}  // namespace

int verify_caster(const VerifyCommand& command, const scene::Scene& scene, const run::Simulation& state) {
  check_picture(command, scene);
  const hwmodel::Preset configured =
      hwmodel::load_preset(find_preset(command.hw), command.hw_sets, hwmodel::Runs::caster);
  const hwmodel::raycast::FaultInfo* fault = hwmodel::raycast::find_fault(command.plant);
  const scene::Camera camera = camera_of(command.picture, scene);
  const hwmodel::raycast::PictureOptions options = options_of(command, configured.caster, fault, camera);
  const hwmodel::raycast::PictureInput input{state.volume(), scene.look, scene.light,
                                             scene.terrain,  camera,     setting_of(command.picture.setting)};
  const hwmodel::raycast::PictureReport report = hwmodel::raycast::verify_picture(input, options);
  if (fault != nullptr && report.good() && !report.strike)
    throw UsageError(fmt::format(
        "error: --plant {}: in this picture there is nothing that this fault could change", command.plant));

  const PictureRun drawn{command, scene, input, options, report, state.step_number()};
  print_picture(drawn);
  const std::optional<SeenAgain> again = see_again(drawn);
  const std::string no_waves = write_waves(command.vcd, command.vcd_from, report.waves);
  write_outputs(drawn, again);
  shrink(drawn);
  if (!no_waves.empty() && report.good()) throw UsageError(no_waves);
  if (!no_waves.empty()) say(no_waves);
  return report.good() && !report.strike ? kDone : kCheckFailed;
}

}  // namespace voxmelt::app
