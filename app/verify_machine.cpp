#include "app/verify_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <string>
#include <string_view>

#include "app/commands.h"
#include "app/interrupt.h"
#include "hwmodel/caster/report/report_picture.h"
#include "hwmodel/machine/report_machine.h"
#include "kernel/run/io/output_folder.h"
#include "measure/paper.h"
#include "render/image/png.h"
#include "render/packet/picture.h"
#include "report/hardware/page.h"

namespace voxmelt::app {
namespace {

// What the software takes for the same steps and pictures: seconds of this processor, one thread, for all of
// them; the best of several runs.
struct Software {
  double steps = 0, update = 0, draw = 0;
  double total() const { return steps + update + draw; }
};

Software measure_software(const scene::Scene& scene, const scene::Camera& camera, render::Setting setting,
                          const run::Simulation& ahead, const step::Implementation& implementation,
                          std::uint32_t steps, std::uint32_t between) {
  constexpr int kRuns = 3;
  Software best;
  for (int round = 0; round < kRuns; ++round) {
    step::Tuning tuning;
    tuning.threads = 1;
    run::Simulation simulation(scene.parameters, ahead.volume(), implementation, tuning);
    simulation.begin_at(ahead.step_number());
    render::Picture picture;
    Software took;
    const auto time = [](double& sum, const auto& work) {
      const std::clock_t begin = std::clock();  // of the processor: the machine may have other work
      work();
      sum += static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    };
    picture.update(simulation.volume(), scene.look, scene.light, scene.terrain, 1);
    for (std::uint32_t done = 0; done < steps; done += between) {
      time(took.steps, [&] {
        for (std::uint32_t i = 0; i < between; ++i) simulation.step();
      });
      time(took.update,
           [&] { picture.update(simulation.volume(), scene.look, scene.light, scene.terrain, 1); });
      time(took.draw, [&] { static_cast<void>(picture.draw(camera, setting, 1)); });
      stop_if_interrupted();
    }
    if (round == 0) best = took;
    best.steps = std::min(best.steps, took.steps);
    best.update = std::min(best.update, took.update);
    best.draw = std::min(best.draw, took.draw);
  }
  return best;
}

// The paper's row of a scene, or of its sister under the viscous law; null: it has none.
const measure::PaperRow* paper_row(std::string_view scene) {
  for (const measure::PaperRow& row : measure::kPaperTable)
    if (scene == row.scene || scene == std::string(row.scene) + "_viscous") return &row;
  return nullptr;
}

std::string verdict_of(const hwmodel::MachineReport& report) {
  std::string text;
  if (report.steps.mismatch != nullptr) text += hwmodel::text_of(*report.steps.mismatch);
  if (report.different_beside > 0)
    text +=
        fmt::format("{} pixels differ that were drawn while the pipeline worked\n", report.different_beside);
  if (report.steps.mismatch == nullptr && report.steps.steps > 0)
    text +=
        fmt::format("{} cells compared behind the stages of the pipeline: no difference; digest {:016x}\n",
                    report.steps.compared_cells, report.steps.digest);
  return text + hwmodel::raycast::verdict_text(report.pictures);
}

}  // namespace

hwmodel::MachineReport verify_machine(const Common& common, const PictureChoice& choice,
                                      const scene::Scene& scene, const run::Simulation& ahead,
                                      const hwmodel::Preset& preset, const hwmodel::VerifyOptions& steps) {
  const scene::Camera camera = camera_of(choice, scene);
  const render::Setting setting = setting_of(choice);
  const auto frames = static_cast<std::uint32_t>(choice.frames);
  if (steps.steps % frames != 0)
    throw UsageError(
        fmt::format("error: --frames {}: --steps {} is no multiple of it (--machine)", frames, steps.steps));
  hwmodel::MachineOptions options;
  options.steps = steps;
  options.picture.configuration = preset.caster;
  options.picture.compare = choice.compare;
  options.picture.frames = choice.frames;
  options.picture.poll = stop_if_interrupted;
  const step::Implementation& fast = find_implementation(common);
  step::Tuning tuning;
  tuning.threads = thread_count(common);
  hwmodel::MachineReport report =
      hwmodel::verify_machine({scene.parameters,
                               ahead.step_number(),
                               fast,
                               tuning,
                               {ahead.volume(), scene.look, scene.light, scene.terrain, camera, setting}},
                              options);

  const hwmodel::Configuration& p = steps.configuration;
  const hwmodel::raycast::Configuration& c = preset.caster;
  if (common.quiet)
    fmt::print("{}: {} cycles, overlapped\n", scene.name, report.sum().overlapped());
  else
    fmt::print("{}: pipeline: lanes {}, cascade {}; ray caster: pipes {}; fifo depth {}, stall seed {}\n",
               scene.name, p.lanes, p.cascade, c.pipes, c.fifo_depth, c.stall_seed);
  if (!common.quiet)
    fmt::print("{} x {}, {}; memory: {}\n", camera.width, camera.height, choice.setting,
               c.dram ? c.dram->name : fmt::format("latency {}, {} bytes a cycle", c.latency, c.bus_bytes));
  nlohmann::ordered_json json{{"scene", scene.name}, {"width", camera.width}, {"height", camera.height}};
  json.update(hwmodel::json_of(report, options));
  if (report.good()) {
    const Software here =
        measure_software(scene, camera, setting, ahead, fast, steps.steps, steps.steps / frames);
    const double n = frames;
    json["software"] = {{"implementation", fast.name},
                        {"threads", 1},
                        {"steps_a_second", steps.steps / here.steps},
                        {"updates_a_second", n / here.update},
                        {"pictures_a_second", n / here.draw},
                        {"frames_a_second", n / here.total()}};
    if (!common.quiet) {
      fmt::print("{}", hwmodel::table_of(report, options));
      fmt::print(
          "the software here, one thread, {}: {:.1f} steps, {:.1f} updates, {:.1f} pictures a second; "
          "{:.1f} frames\n",
          fast.name, steps.steps / here.steps, n / here.update, n / here.draw, n / here.total());
      if (const measure::PaperRow* row = paper_row(scene.name))
        fmt::print("the paper, 2003, {}: gravity {:.1f} ms, spreading {:.1f}, update {:.1f}: {:.1f} frames\n",
                   row->as, row->gravity, row->spreading, row->update, row->frames());
    }
  }
  fmt::print("{}", common.quiet ? first_line(verdict_of(report)) : verdict_of(report));
  write_report(common, json.dump(2) + '\n');
  if (!choice.html.empty())
    io::write_file(choice.html, hwmodel::machine_page(json, fmt::format("{}, {} x {}", scene.name,
                                                                        camera.width, camera.height)));
  if (!choice.png.empty()) render::write_png(choice.png, report.pictures.image);
  return report;
}

}  // namespace voxmelt::app
