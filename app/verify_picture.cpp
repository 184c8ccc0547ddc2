#include "app/verify_picture.h"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

#include "app/commands.h"
#include "app/film.h"
#include "app/interrupt.h"
#include "hwmodel/caster_faults/faults.h"
#include "hwmodel/picture/report_picture.h"
#include "hwmodel/picture/verify_picture.h"
#include "hwmodel/presets/caster_preset.h"
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

}  // namespace

void add_picture_choice(CLI::App& command, PictureChoice& choice) {
  command.add_flag("--picture", choice.asked, "verify the ray caster: one picture, after --from steps");
  command.add_option("--view", choice.view, "with --picture: the camera's AZIMUTH,ELEVATION in degrees");
  command.add_option("--size", choice.size, "with --picture: size in pixels, e.g. 256x256");
  command
      .add_option("--setting", choice.setting,
                  "with --picture: samples per pixel: fast 1, normal 1 or 8, best 1 or 32")
      ->check(CLI::IsMember({"fast", "normal", "best"}))
      ->capture_default_str();
  command
      .add_option("--frames", choice.frames,
                  "with --picture: draw it so often; later frames find warm caches")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command.add_flag("!--no-compare", choice.compare,
                   "with --picture: compare the bytes alone, not every stage");
  command.add_option("--png", choice.png, "with --picture: write the ray caster's picture");
}

int verify_picture(const Common& common, const PictureChoice& choice, const scene::Scene& scene,
                   const run::Simulation& state, const fs::path& preset,
                   const std::vector<std::string>& hw_sets) {
  scene::Camera camera = scene.camera;
  if (!choice.size.empty()) set_size(camera, choice.size);
  if (!choice.view.empty()) set_view(camera, choice.view);
  const hwmodel::CasterPreset configured = hwmodel::load_caster_preset(preset, hw_sets);
  const render::Setting setting = choice.setting == "fast"   ? render::Setting::fast
                                  : choice.setting == "best" ? render::Setting::best
                                                             : render::Setting::normal;
  const hwmodel::raycast::FaultInfo* fault = hwmodel::raycast::find_fault(choice.plant);
  if (!choice.plant.empty() && fault == nullptr)
    throw UsageError(fmt::format(
        "error: --plant {}: unknown in the ray caster; `voxmelt list faults` names them", choice.plant));
  if (!choice.plant.empty() && !choice.compare)
    throw UsageError("error: --plant: with --no-compare no stage is compared");
  check_report_place(common, "");
  hwmodel::raycast::PictureOptions options;
  options.configuration = configured.configuration;
  options.compare = choice.compare;
  options.frames = choice.frames;
  if (fault != nullptr) options.fault = fault->fault;
  options.poll = stop_if_interrupted;
  const hwmodel::raycast::PictureReport report = hwmodel::raycast::verify_picture(
      {state.volume(), scene.look, scene.light, scene.terrain, camera, setting}, options);

  if (fault != nullptr && report.good() && !report.strike)
    throw UsageError(fmt::format(
        "error: --plant {}: in this picture there is nothing that this fault could change", choice.plant));

  fmt::print("{}: step {}, {} x {}, {}; pipes {}, fifo depth {}, stall seed {}\n", scene.name,
             state.step_number(), camera.width, camera.height, choice.setting, options.configuration.pipes,
             options.configuration.fifo_depth, options.configuration.stall_seed);
  if (!common.quiet) fmt::print("{}", hwmodel::raycast::table_of(report, options.configuration));
  fmt::print("{}", hwmodel::raycast::verdict_text(report));
  write_report(common, hwmodel::raycast::json_of(report, options.configuration).dump(2) + '\n');
  if (!choice.png.empty()) render::write_png(choice.png, report.image);
  return report.good() && !report.strike ? kDone : kCheckFailed;
}

}  // namespace voxmelt::app
