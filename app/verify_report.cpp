#include "app/verify_report.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "hwmodel/caster/report/report_memory.h"
#include "hwmodel/caster/report/report_picture.h"
#include "hwmodel/machine/report_machine.h"
#include "hwmodel/pipeline/report/report.h"
#include "kernel/run/io/output_folder.h"
#include "report/hardware/page.h"

namespace voxmelt::app {
namespace {

using Json = nlohmann::ordered_json;
using Page = std::string (*)(const Json& report, const std::string& title);

void write(const ReportPlaces& places, const Json& json, Page page, const std::string& title) {
  write_report(places.common, json.dump(2) + '\n');
  if (!places.html.empty()) io::write_file(places.html, page(json, title));
}

}  // namespace

void write_pipeline_report(const ReportPlaces& places, const std::string& name, const Verified& run) {
  const hwmodel::VerifyReport& report = run.report;
  Json json{{"scene", name}};
  json.update(hwmodel::json_of(report, run.design, run.configuration));
  json["hw"]["memory"] = run.dram ? Json(run.dram->parameters.name) : Json();
  json["hw"]["clock_mhz"] = run.dram ? Json(run.clock_mhz) : Json();
  if (run.dram) json["dram"] = hwmodel::memory_json(run.dram->counts, run.dram->parameters);
  if (run.cost) json["energy"] = json_of(*run.cost, run.clock_mhz);
  write(places, json, hwmodel::pipeline_page,
        fmt::format("{}, {} steps from step {}", name, report.steps, report.first_step));
}

void write_picture_report(const ReportPlaces& places, const Drawn& drawn, std::uint32_t step,
                          const hwmodel::raycast::PictureReport& report,
                          const hwmodel::raycast::Configuration& configuration,
                          const std::optional<SeenAgain>& again) {
  Json json{{"scene", drawn.scene}, {"step", step}, {"width", drawn.width}, {"height", drawn.height}};
  json.update(hwmodel::raycast::json_of(report, configuration));
  if (again) json["replay"] = {{"pixel", again->pixel}, {"fails_alone", again->fails_alone}};
  write(places, json, hwmodel::picture_page,
        fmt::format("{}, step {}, {} x {}", drawn.scene, step, drawn.width, drawn.height));
}

void write_machine_report(const ReportPlaces& places, const Drawn& drawn,
                          const hwmodel::MachineReport& report, const hwmodel::MachineOptions& options,
                          const std::optional<SoftwareRates>& software) {
  Json json{{"scene", drawn.scene}, {"width", drawn.width}, {"height", drawn.height}};
  json.update(hwmodel::json_of(report, options));
  if (software)
    json["software"] = {{"implementation", software->implementation}, {"threads", 1},
                        {"steps_a_second", software->steps},          {"updates_a_second", software->updates},
                        {"pictures_a_second", software->pictures},    {"frames_a_second", software->frames}};
  write(places, json, hwmodel::machine_page,
        fmt::format("{}, {} x {}", drawn.scene, drawn.width, drawn.height));
}

}  // namespace voxmelt::app
