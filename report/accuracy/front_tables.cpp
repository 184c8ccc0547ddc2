// The files front.json and front.csv have every number that was measured.
#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "accuracy/front/pareto.h"
#include "report/accuracy/front.h"

namespace voxmelt::accuracy {
namespace {

using json = nlohmann::ordered_json;
using front::Measured;

json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }
json or_null(const std::optional<double>& value) { return value ? number(*value) : json(nullptr); }

json errors_json(const front::Errors& errors) {
  json out = {{"largest", number(errors.largest())}};
  for (std::size_t i = 0; i < front::kCurves.size(); ++i)
    out[front::kCurveNames[i]] = number(errors.*front::kCurves[i]);
  return out;
}
json errors_json(const std::optional<front::Errors>& errors) {
  return errors ? errors_json(*errors) : json(nullptr);
}

const char* format_of(front::Arithmetic arithmetic) {
  constexpr const char* kNames[] = {"u8", "u16", "u32", "float", "double"};
  return kNames[static_cast<std::size_t>(arithmetic.number)];
}
const char* rounding_of(front::Arithmetic arithmetic) {
  constexpr const char* kNames[] = {"truncate", "nearest", "dithered"};
  return front::is_real(arithmetic.number) ? "" : kNames[static_cast<std::size_t>(arithmetic.rounding)];
}

json reference_json(const front::Setting& s) {
  return {{"step", s.step},
          {"neighbours", s.neighbours},
          {"rays_per_face", s.rays},
          {"visibility_every", s.interval},
          {"substeps_max", s.substeps_max}};
}

json point_json(const front::Swept& swept, std::size_t index, const std::set<std::size_t>& on_front,
                const std::set<std::size_t>& on_bits_front) {
  const Measured& point = swept.points[index];
  const front::Setting& s = point.choice.setting;
  return {{"scene", swept.subject->scene},
          {"axis", front::name_of(point.choice.axis)},
          {"name", front::text_of(point.choice)},
          {"grid", s.grid},
          {"step", s.step},
          {"neighbours", s.neighbours},
          {"rays_per_face", s.rays},
          {"visibility_every", s.interval},
          {"substeps", swept.subject->viscous ? json(s.substeps) : json(nullptr)},
          {"format", format_of(s.arithmetic)},
          {"rounding", rounding_of(s.arithmetic)},
          {"computed_by", point.twin ? "twin" : "engine"},
          {"arithmetic_error", errors_json(point.arithmetic)},
          {"model_error", errors_json(point.model)},
          {"whole_error", errors_json(point.whole)},
          {"grid_error", errors_json(point.grid)},
          {"state_bits", point.cost.state_bits},
          {"run_seconds", or_null(point.cost.run_seconds)},
          {"cells_per_second", number(point.cost.cells_per_second)},
          {"baseline_cells_per_second", or_null(point.cost.baseline_cells_per_second)},
          {"speed_over_twin_in_u16", point.twin ? number(point.cost.over_twin) : json(nullptr)},
          {"on_the_front", on_front.count(index) > 0},
          {"on_the_front_of_formats", on_bits_front.count(index) > 0}};
}

std::set<std::size_t> front_of(const front::Plotted& plotted) {
  std::set<std::size_t> found;
  for (const std::size_t i : front::undominated(plotted.places)) found.insert(plotted.point[i]);
  return found;
}

std::vector<json> points_json(const FrontReport& report) {
  std::vector<json> points;
  for (const front::Swept& swept : report.swept) {
    const auto on_front = front_of(front::run_time_against_whole_error(swept)),
               on_bits_front = front_of(front::bits_against_arithmetic_error(swept));
    for (std::size_t i = 0; i < swept.points.size(); ++i)
      points.push_back(point_json(swept, i, on_front, on_bits_front));
  }
  return points;
}

std::string cell_text(const json& value) {
  if (value.is_null()) return "";
  if (value.is_string()) return fmt::format("\"{}\"", value.get<std::string>());
  if (value.is_object()) return cell_text(value["largest"]);
  return value.dump();
}

}  // namespace

int FrontReport::points() const {
  std::size_t count = 0;
  for (const front::Swept& one : swept) count += one.points.size();
  return static_cast<int>(count);
}

int FrontReport::axes() const {
  std::set<front::Axis> found;
  for (const front::Swept& one : swept)
    for (const Measured& point : one.points)
      if (point.choice.axis != front::Axis::usual && point.choice.axis != front::Axis::several)
        found.insert(point.choice.axis);
  return static_cast<int>(found.size());
}

std::string percent_text(double part) {
  const double percent = 100 * part;
  if (percent == 0) return "0 %";
  return fmt::format("{:.{}g} %", percent, percent >= 10 ? 3 : 2);
}

std::string json_text(const FrontReport& report) {
  json scenes = json::array();
  for (const front::Swept& swept : report.swept)
    scenes.push_back({{"scene", swept.subject->scene},
                      {"grid", swept.reference.grid},
                      {"reference", reference_json(swept.reference)},
                      {"finest_grid", swept.finest_grid.grid},
                      {"error_between_seeds", number(swept.seed_error)}});
  const json all = {{"version", report.version},
                    {"implementation", report.implementation},
                    {"threads", 1},
                    {"quick", report.extent == front::Extent::quick},
                    {"seconds", report.seconds},
                    {"axes", report.axes()},
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
