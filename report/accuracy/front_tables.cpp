// The files front.json and front.csv have every number that was measured.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "report/accuracy/front.h"

namespace voxmelt::accuracy {
namespace {

using json = nlohmann::ordered_json;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json setting_json(const front::Setting& s) {
  return {{"grid", s.grid},
          {"step", s.step},
          {"rays_per_face", s.rays},
          {"visibility_every", s.interval},
          {"substeps_max", s.substeps_max},
          {"stages_max", s.stages_max},
          {"neighbours", s.neighbours}};
}

json point_json(const front::Swept& swept, const front::Measured& point) {
  json out = {{"scene", swept.subject->scene},
              {"axis", front::name_of(point.axis)},
              {"name", front::text_of(point.axis, point.setting)}};
  out.update(setting_json(point.setting));
  out["usual"] = point.setting == swept.usual;
  out["reference"] = point.reference;
  out["error"] = number(point.difference.error());
  for (std::size_t i = 0; i < front::kCurves.size(); ++i)
    out[fmt::format("{}_error", front::kCurveNames[i])] = number(point.difference.curves.*front::kCurves[i]);
  out["map_error"] = number(point.difference.map);
  out["run_seconds"] = number(point.seconds);
  return out;
}

json points_json(const FrontReport& report) {
  json points = json::array();
  for (const front::Swept& swept : report.swept)
    for (const front::Measured& point : swept.points) points.push_back(point_json(swept, point));
  return points;
}

json pick_json(const front::Pick& pick) {
  json without = json::array();
  for (const front::Axis axis : pick.without) without.push_back(front::name_of(axis));
  return {{"bound", pick.bound},
          {"none", pick.none},
          {"setting", pick.none ? json(nullptr) : setting_json(pick.setting)},
          {"without", without},
          {"error_sum", number(pick.sum)},
          {"curves_alone", pick.curves_alone},
          {"run_seconds", pick.none ? json(nullptr) : number(pick.seconds)}};
}

json format_json(const front::Format& format) {
  return {{"name", front::name_of(format.arithmetic)},
          {"error", number(format.error)},
          {"state_bits", format.state_bits}};
}

json scene_json(const front::Swept& swept) {
  json picks = json::array(), formats = json::array();
  for (const front::Pick& pick : swept.picks) picks.push_back(pick_json(pick));
  for (const front::Format& format : swept.formats) formats.push_back(format_json(format));
  return {{"scene", swept.subject->scene},
          {"usual", setting_json(swept.usual)},
          {"usual_seconds", number(swept.usual_seconds)},
          {"noise_of_curves", number(swept.noise.curves)},
          {"noise_of_map", number(swept.noise.map)},
          {"picks", picks},
          {"formats", formats}};
}

std::string cell_text(const json& value) {
  if (value.is_null()) return "";
  return value.is_string() ? fmt::format("\"{}\"", value.get<std::string>()) : value.dump();
}

}  // namespace

int FrontReport::points() const {
  std::size_t count = 0;
  for (const front::Swept& one : swept) count += one.points.size();
  return static_cast<int>(count);
}

std::string percent_text(double part) {
  const double percent = 100 * part;
  if (percent == 0) return "0 %";
  return fmt::format("{:.{}g} %", percent, percent >= 10 ? 3 : 2);
}

std::string json_text(const FrontReport& report) {
  json scenes = json::array();
  for (const front::Swept& swept : report.swept) scenes.push_back(scene_json(swept));
  const json all = {{"version", report.version},
                    {"implementation", report.implementation},
                    {"threads", 1},
                    {"quick", report.extent == front::Extent::quick},
                    {"seconds", report.seconds},
                    {"scenes", scenes},
                    {"points", points_json(report)}};
  return all.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::string csv_text(const FrontReport& report) {
  std::string out;
  for (const json& point : points_json(report)) {
    std::string names, values;
    for (const auto& [name, value] : point.items()) {
      names += fmt::format("{}{}", names.empty() ? "" : ",", name);
      values += fmt::format("{}{}", values.empty() ? "" : ",", cell_text(value));
    }
    if (out.empty()) out = names + '\n';
    out += values + '\n';
  }
  return out;
}

}  // namespace voxmelt::accuracy
