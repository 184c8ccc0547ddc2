#include "hwmodel/machine/report_machine.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "hwmodel/caster/report/report_picture.h"
#include "hwmodel/memory/ratio.h"

namespace voxmelt::hwmodel {
namespace {

using Json = nlohmann::ordered_json;

// Returns how often a second something happens that happens `times` times in `cycles`.
double rate(double times, std::int64_t cycles, int clock_mhz) {
  return ratio(times * 1e6 * clock_mhz, cycles);
}

std::int64_t upload_bytes(const Period& period) { return period.upload.bursts * raycast::kBurst; }

Json json_of(const Period& period) {
  return {{"step", period.step},
          {"steps",
           {{"passes", period.work.passes},
            {"cycles", period.work.cycles},
            {"tokens", period.work.tokens},
            {"cycles_on_memory", period.stream},
            {"read_bytes", (period.work.read_bits + 7) / 8},
            {"irradiance_bytes", (period.work.fed_bits + 7) / 8},
            {"written_bytes", (period.work.written_bits + 7) / 8}}},
          {"upload", raycast::json_of(period.upload)},
          {"frame",
           {{"cycles", period.frame},
            {"read_bytes", period.frame_read},
            {"written_bytes", period.frame_written},
            {"bus_cycles", period.frame_bus}}},
          {"together",
           {{"cycles", period.together}, {"steps", period.stream_beside}, {"frame", period.frame_beside}}},
          {"cycles_in_turn", period.in_turn()},
          {"cycles_overlapped", period.overlapped()},
          {"host_seconds", period.host_seconds}};
}

// Lists upper bounds of the cell-steps a cycle, each below the one before. Then come the rates that the
// pipeline reached: alone on the memory, and beside the upload and the ray caster.
Json rate_of_cells(const MachineReport& report, const MachineOptions& options) {
  const Period sum = report.sum();
  const Configuration& c = options.steps.configuration;
  const double cells = static_cast<double>(report.cells) * report.steps.steps;
  const std::int64_t own = sum.work.bytes();
  const std::int64_t all = own + sum.frame_read + sum.frame_written + upload_bytes(sum);
  return {{"lanes_and_steps", static_cast<double>(c.lanes * c.cascade)},
          {"always_answered", ratio(cells, sum.work.cycles)},
          {"alone", ratio(cells, sum.stream)},
          {"reached", ratio(cells, sum.overlapped())},
          {"bytes_per_cycle_alone", ratio(own, sum.stream)},
          {"bytes_per_cycle", ratio(all, sum.overlapped())},
          {"most_bytes_per_cycle", options.picture.configuration.memory().most_bytes_per_cycle()},
          {"cell_steps_per_byte", ratio(cells, own)}};
}

}  // namespace

std::vector<Bound> bounds_of(const MachineReport& report, const MachineOptions& options) {
  const Period sum = report.sum();
  const std::int64_t all = sum.overlapped();
  // The accounts are those of all frames; the share of a stage is nearly the same in each.
  const raycast::StageAccount* busiest = nullptr;
  for (const raycast::StageAccount& stage : report.pictures.stages)
    if (busiest == nullptr || stage.account.busy > busiest->account.busy) busiest = &stage;
  std::vector<Bound> bounds{{"tokens of the pipeline", ratio(sum.work.tokens, all)}};
  if (busiest != nullptr)
    bounds.push_back({"stage " + busiest->name + " of the ray caster",
                      ratio(busiest->account.busy, busiest->account.total()) * ratio(sum.frame_beside, all)});
  const double bus = static_cast<double>(sum.frame_bus) +
                     ratio(sum.work.bytes() + upload_bytes(sum),
                           options.picture.configuration.memory().most_bytes_per_cycle());
  bounds.push_back({"bytes on the memory's bus", ratio(bus, all)});
  bounds.push_back({"upload, while both wait", ratio(sum.upload.cycles, all)});
  std::stable_sort(bounds.begin(), bounds.end(),
                   [](const Bound& a, const Bound& b) { return a.share > b.share; });
  return bounds;
}

std::string table_of(const MachineReport& report, const MachineOptions& options) {
  constexpr const char* kLine = "{:<8}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}{:>12}\n";
  const Period sum = report.sum();
  std::string text = fmt::format(kLine, "step", "steps", "bytes", "upload", "bytes", "frame", "bytes",
                                 "in turn", "together", "overlapped");
  const auto row = [&](const std::string& name, const Period& period, std::int64_t n) {
    text += fmt::format(kLine, name, period.stream / n, period.work.bytes() / n, period.upload.cycles / n,
                        upload_bytes(period) / n, period.frame / n,
                        (period.frame_read + period.frame_written) / n, period.in_turn() / n,
                        period.together / n, period.overlapped() / n);
  };
  for (const Period& period : report.periods) row(std::to_string(period.step), period, 1);
  const std::int64_t frames = report.periods.size();
  if (frames == 0) return text;
  row("mean", sum, frames);
  text += fmt::format("before: upload of everything {} bytes, {} cycles; the first frame {} cycles\n",
                      report.first_upload.bursts * raycast::kBurst, report.first_upload.cycles,
                      report.first_frame);
  text += fmt::format("pipeline: {} cycles of {} on a memory that always answers ({} passes of {} tokens)\n",
                      sum.stream, sum.work.cycles, sum.work.passes,
                      sum.work.tokens / std::max<std::int64_t>(sum.work.passes, 1));
  text += fmt::format("in memory: {} bytes of state, {} of irradiance, {} of the ray caster\n",
                      report.state_bytes, report.irradiance_bytes, report.pictures.memory_bytes);

  const auto n = static_cast<double>(frames);
  const double steps = report.steps.steps;
  const auto rates = [&](const char* name, std::int64_t cycles) {
    text += fmt::format("{:<12}{:.1f} frames and {:.1f} steps a second at {} MHz\n", name,
                        rate(n, cycles, options.clock_mhz()), rate(steps, cycles, options.clock_mhz()),
                        options.clock_mhz());
  };
  rates("in turn:", sum.in_turn());
  rates("overlapped:", sum.overlapped());
  text += fmt::format("alone: {:.1f} steps a second by the pipeline, {:.1f} frames by the ray caster\n",
                      rate(steps, sum.stream, options.clock_mhz()), rate(n, sum.frame, options.clock_mhz()));
  text += "of the overlapped cycles:";
  const std::vector<Bound> bounds = bounds_of(report, options);
  for (const Bound& bound : bounds) text += fmt::format(" {} {:.0f} %;", bound.name, 100 * bound.share);
  text += fmt::format(" bound by {}\n", bounds.front().name);
  text += fmt::format(
      "the host takes {:.2f} ms a frame for field, light and comparing, on this machine: {:.1f} a second\n",
      1e3 * sum.host_seconds / n, ratio(n, sum.host_seconds));
  return text;
}

Json json_of(const MachineReport& report, const MachineOptions& options) {
  Json json{{"good", report.good()},
            {"clock_mhz", options.clock_mhz()},
            {"first_step", report.steps.first_step},
            {"steps", report.steps.steps},
            {"frames", report.periods.size()},
            {"compared_cells", report.steps.compared_cells},
            {"digest", fmt::format("{:016x}", report.steps.digest)},
            {"state_bytes", report.state_bytes},
            {"irradiance_bytes", report.irradiance_bytes},
            {"first_upload", raycast::json_of(report.first_upload)},
            {"first_frame_cycles", report.first_frame},
            {"periods", Json::array()}};
  for (const Period& period : report.periods) json["periods"].push_back(json_of(period));
  const Period sum = report.sum();
  const auto n = static_cast<double>(report.periods.size());
  const double steps = report.steps.steps;
  const auto rates = [&](std::int64_t cycles) {
    return Json{{"frames", rate(n, cycles, options.clock_mhz())},
                {"steps", rate(steps, cycles, options.clock_mhz())}};
  };
  json["a_second"] = {{"in_turn", rates(sum.in_turn())}, {"overlapped", rates(sum.overlapped())}};
  json["a_second"]["pipeline_alone"] = rate(steps, sum.stream, options.clock_mhz());
  json["a_second"]["caster_alone"] = rate(n, sum.frame, options.clock_mhz());
  for (const Bound& bound : bounds_of(report, options))
    json["bounds"].push_back({{"name", bound.name}, {"share", bound.share}});
  if (report.good() && !report.periods.empty()) json["cell_steps_per_cycle"] = rate_of_cells(report, options);
  json["caster"] = raycast::json_of(report.pictures, options.picture.configuration);
  return json;
}

}  // namespace voxmelt::hwmodel
