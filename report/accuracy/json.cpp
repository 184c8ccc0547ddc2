#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <string>

#include "report/accuracy/report.h"

namespace voxmelt::accuracy {
namespace {

using json = nlohmann::ordered_json;

json or_null(const std::optional<double>& value) { return value ? json(*value) : json(nullptr); }
json number(double value) { return std::isfinite(value) ? json(value) : json(nullptr); }

json row_json(const Found& found, const Row& row) {
  return {{"name", found.one->name},
          {"setting", row.setting},
          {"quantity", row.quantity},
          {"value", number(row.value)},
          {"exact", number(row.exact)},
          {"error", number(row.error())},
          {"error_is", row.measure == Measure::relative ? "relative" : "absolute"},
          {"gate", or_null(row.gate)},
          {"passed", row.passed()},
          {"cells_per_second", number(row.speed.cells_per_second)},
          {"baseline_cells_per_second", or_null(row.speed.baseline_cells_per_second)},
          {"state_bits", row.speed.state_bits},
          {"note", row.note}};
}

json chart_json(const Found& found, const Chart& chart) {
  json curves = json::array();
  for (const Curve& curve : chart.curves) {
    json points = json::array();
    for (const Point& p : curve.points) points.push_back({number(p.x), number(p.y)});
    curves.push_back({{"name", curve.name}, {"exact", curve.exact}, {"points", points}});
  }
  return {{"name", found.one->name},
          {"title", chart.title},
          {"x", chart.x_label},
          {"y", chart.y_label},
          {"curves", curves}};
}

}  // namespace

bool Report::passed() const { return missed() == 0; }

int Report::gates() const {
  int count = 0;
  for (const Found& one : found)
    for (const Row& row : one.outcome.rows) count += row.gate.has_value();
  return count;
}

int Report::missed() const {
  int count = 0;
  for (const Found& one : found)
    for (const Row& row : one.outcome.rows) count += !row.passed();
  return count;
}

std::string json_text(const Report& report) {
  json rows = json::array(), charts = json::array(), seconds = json::object();
  for (const Found& one : report.found) {
    for (const Row& row : one.outcome.rows) rows.push_back(row_json(one, row));
    for (const Chart& chart : one.outcome.charts) charts.push_back(chart_json(one, chart));
    seconds[one.one->name] = one.seconds;
  }
  const json all = {{"version", report.version},
                    {"implementation", report.implementation},
                    {"threads", report.threads},
                    {"quick", report.quick},
                    {"set", report.sets},
                    {"passed", report.passed()},
                    {"gates", report.gates()},
                    {"missed", report.missed()},
                    {"cases", rows},
                    {"charts", charts},
                    {"seconds", seconds}};
  return all.dump(1, ' ', false, json::error_handler_t::replace) + "\n";
}

}  // namespace voxmelt::accuracy
