#include <nlohmann/json.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

using json = nlohmann::ordered_json;

json number(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }
json grid_json(const state::Grid& grid) { return {grid.x, grid.y, grid.z}; }

json machine_json(const Findings& findings) {
  const MachineText& text = findings.machine_text;
  json bandwidth = json::array(), rates = json::array();
  for (const auto& [key, found] : findings.machine.bandwidths())
    bandwidth.push_back({{"footprint_bytes", key.first},
                         {"threads", key.second},
                         {"copy_bytes_per_second", found.copy},
                         {"update_bytes_per_second", found.update}});
  for (const auto& [key, found] : findings.machine.rates())
    rates.push_back({{"instruction_set", cpu::name_of(key.first)},
                     {"threads", key.second},
                     {"multiply_lanes_per_second", found.multiply},
                     {"add_lanes_per_second", found.add}});
  return {{"processor", text.processor},
          {"threads", text.threads},
          {"l1_bytes", text.l1_bytes},
          {"l2_bytes", text.l2_bytes},
          {"l3_bytes", text.l3_bytes},
          {"memory_bytes", text.memory_bytes},
          {"load_average", {{"before", findings.load_before}, {"after", findings.load_after}}},
          {"bandwidth", bandwidth},
          {"lanes_16_bit", rates}};
}

json needed_json(const Case& one) {
  if (!one.needed) return nullptr;
  return {{"gravity_vectors", one.needed->gravity},
          {"spread_vectors", one.needed->spread},
          {"heat_vectors", one.needed->heat},
          {"milliseconds_at_full_volume_speed",
           one.least_seconds ? json(*one.least_seconds * 1e3) : json(nullptr)}};
}

json case_json(const Case& one) {
  json phases;
  for (std::size_t p = 0; p < step::kPhaseCount; ++p)
    phases[std::string(step::kPhaseNames[p])] = one.step.phase[p] * 1e3;
  json roof = nullptr;
  if (one.roof)
    roof = {{"operations_cells_per_second", one.roof->operations},
            {"bytes_cells_per_second", one.roof->bytes},
            {"multiply_rate_cells_per_second", one.roof->multiplies}};
  return {{"name", one.name},
          {"subject", name_of(one.subject)},
          {"workload", one.workload},
          {"implementation", one.implementation},
          {"threads", one.threads},
          {"checked_against", one.judge},
          {"grid", grid_json(one.grid)},
          {"cells", one.cells},
          {"active_cells", one.active},
          {"rounds", one.rounds},
          {"milliseconds", one.seconds * 1e3},
          {"median_milliseconds", one.median_seconds * 1e3},
          {"phase_milliseconds", phases},
          {"cells_per_second", one.cells_per_second()},
          {"active_cells_per_second", one.active_per_second()},
          {"nanoseconds_per_active_cell", 1e9 / one.active_per_second()},
          {"bytes_per_cell", one.bytes_per_cell},
          {"multiplies_per_cell", one.work.multiplies},
          {"other_operations_per_cell", one.work.others},
          {"needed", needed_json(one)},
          {"roof", roof},
          {"percent_of_roof", number(one.percent_of_roof())},
          {"ratio_to_baseline", number(one.ratio_to_baseline)},
          {"ratio_to_native_baseline", number(one.ratio_to_native)}};
}

// Writes times in milliseconds.
json drawing_json(const Drawing& one) {
  json rays, timings = json::array();
  for (std::size_t i = 0; i < kSettings.size(); ++i) rays[kSettingNames[i]] = one.rays[i];
  for (const DrawingTiming& timing : one.timings) {
    json the_json = {{"instruction_set", cpu::name_of(timing.set)},
                     {"threads", timing.threads},
                     {"field", timing.field * 1e3},
                     {"light_and_bricks", timing.light * 1e3},
                     {"unchanged", timing.unchanged * 1e3}};
    for (std::size_t i = 0; i < kSettings.size(); ++i) {
      the_json[kSettingNames[i]] = timing.draw[i] * 1e3;
      the_json[std::string(kSettingNames[i]) + "_nanoseconds_per_ray"] = one.nanoseconds_per_ray(timing, i);
    }
    timings.push_back(the_json);
  }
  return {{"workload", one.workload},
          {"grid", grid_json(one.grid)},
          {"side", kPictureSide},
          {"checked_against", "plain painter"},
          {"rounds", one.rounds},
          {"bricks_filtered", one.bricks},
          {"rays", rays},
          {"png", one.encode * 1e3},
          {"png_bytes", one.png_bytes},
          {"timings", timings}};
}

json grids_json(const std::vector<FinerGrid>& grids) {
  json all = json::array();
  for (std::size_t i = 0; i < grids.size(); ++i)
    for (std::size_t t = 0; t < grids[i].timings.size(); ++t) {
      const FinerGrid::Timing& timing = grids[i].timings[t];
      all.push_back({{"workload", grids[i].scene},
                     {"grid", grid_json(grids[i].grid)},
                     {"rounds", grids[i].rounds},
                     {"instruction_set", cpu::name_of(timing.set)},
                     {"fast", timing.fast * 1e3},
                     {"normal", timing.normal * 1e3},
                     {"growth_of_normal", number(growth_of_normal(grids, i, t))}});
    }
  return all;
}

json film_json(const MeltFilm& film) {
  return {{"scene", film.scene},
          {"grid", grid_json(film.grid)},
          {"steps", film.steps},
          {"frames", film.frames},
          {"threads", film.threads},
          {"rounds", film.rounds},
          {"seconds", film.seconds},
          {"processor_seconds", film.processor_seconds},
          {"frames_per_second", film.frames_per_second()}};
}

// Writes times in milliseconds.
json transfer_json(const Transfer& one) {
  return {{"milliseconds", one.seconds * 1e3}, {"bytes", one.bytes}};
}

json device_picture_json(const std::optional<DevicePictureTime>& one) {
  if (!one) return nullptr;
  return {{"width", one->width},
          {"height", one->height},
          {"milliseconds", one->seconds() * 1e3},
          {"draw_milliseconds", one->draw * 1e3},
          {"launches", one->launches},
          {"fetched_bytes", one->fetched},
          {"processor_milliseconds", one->processor * 1e3}};
}

json device_case_json(const DeviceCase& one) {
  json kernels = json::array();
  for (const KernelTime& kernel : one.kernels)
    kernels.push_back(
        {{"name", kernel.name}, {"milliseconds", kernel.seconds * 1e3}, {"calls", kernel.calls}});
  return {{"workload", one.workload},
          {"checked_against", one.judge},
          {"grid", grid_json(one.grid)},
          {"cells", one.cells},
          {"active_cells", one.active},
          {"rounds", one.rounds},
          {"milliseconds", one.seconds * 1e3},
          {"milliseconds_in_a_run", one.as_run * 1e3},
          {"bytes_per_cell", one.bytes_per_cell},
          {"percent_of_copy", one.percent_of_copy()},
          {"launches", one.launches},
          {"percent_of_launches", one.percent_of_launches()},
          {"kernels", kernels},
          {"visibility",
           one.rays > 0 ? json{{"milliseconds", one.visibility * 1e3}, {"rays", one.rays}} : json(nullptr)},
          {"upload", transfer_json(one.upload)},
          {"masks", transfer_json(one.masks)},
          {"download", transfer_json(one.download)},
          {"picture", device_picture_json(one.picture)},
          {"processor",
           {{"implementation", one.processor.implementation->name},
            {"threads", one.processor.threads},
            {"milliseconds", one.processor_seconds * 1e3},
            {"times_as_long", one.times_processor()}}}};
}

json device_json(const Findings& findings) {
  if (!findings.device) return nullptr;
  const DeviceMachine& device = *findings.device;
  json cases = json::array();
  for (const DeviceCase& one : findings.device_cases) cases.push_back(device_case_json(one));
  return {{"implementation", device.implementation},
          {"name", device.name},
          {"driver", device.driver},
          {"memory_bytes", device.memory},
          {"copy_bytes_per_second", device.copy},
          {"launch_seconds", device.launch},
          {"cases", cases}};
}

}  // namespace

std::string bench_json(const Findings& findings, const std::string& version) {
  json cases = json::array(), table_1 = json::array(), scaling = json::array(), drawings = json::array(),
       films = json::array();
  for (const Case& one : findings.cases) cases.push_back(case_json(one));
  for (const TableRow& row : findings.table_1)
    table_1.push_back({{"scene", row.scene},
                       {"program", row.program},
                       {"grid", grid_json(row.grid)},
                       {"gravity_ms", row.gravity},
                       {"spreading_ms", row.spreading},
                       {"update_ms", row.update},
                       {"frames_per_second", row.frames_per_second}});
  for (const Scaling& one : findings.scaling)
    scaling.push_back({{"workload", one.workload},
                       {"implementation", one.implementation},
                       {"threads", one.threads},
                       {"speedup", one.speedup},
                       {"efficiency", one.efficiency()}});
  for (const Drawing& one : findings.drawings) drawings.push_back(drawing_json(one));
  for (const MeltFilm& one : findings.films) films.push_back(film_json(one));
  const json report = {{"version", version},
                       {"machine", machine_json(findings)},
                       {"cases", cases},
                       {"paper_table_1", table_1},
                       {"scaling", scaling},
                       {"pictures", drawings},
                       {"finer_grids", grids_json(findings.finer_grids)},
                       {"films", films},
                       {"device", device_json(findings)}};
  return report.dump(2, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace voxmelt::measure
