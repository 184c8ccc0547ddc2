// The page of the front first says in words which setting to take. Then it has the pictures, then every
// point.
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/front/pareto.h"
#include "accuracy/front/words.h"
#include "report/accuracy/front.h"
#include "report/accuracy/front_svg.h"
#include "report/accuracy/front_text.h"
#include "report/accuracy/report.h"
#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

using page::escaped;

using front::Axis;
using front::Measured;
using front::Swept;

constexpr const char* kFrontStyle = R"(
.picks { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(300px, 100%), 1fr)); gap: 14px; }
.picks a { color: inherit; }
.picks .card { margin: 0; padding: 18px 20px 12px; }
dl { display: grid; grid-template-columns: 52px 1fr; gap: 6px 10px; margin: 8px 0; font-size: 14.5px; }
dt { font-weight: 700; } dd { margin: 0; }
h4 { font-size: 14px; margin: 14px 0 0; color: var(--soft); font-weight: 600; }
.ring { fill: none; stroke: var(--ink); stroke-width: 1.5; }
.front { stroke-width: 1.4; }
figure ol { font-size: 13px; margin: 8px 0 0; padding-left: 26px; color: var(--soft); }
summary { cursor: pointer; margin: 12px 0; }
.many table { min-width: 980px; } .many th:last-child { width: 84px; }
@media (max-width: 600px) { main { padding: 28px 14px 60px; } .card { padding: 18px 14px 12px; } h1 { font-size: 28px; } }
)";

struct Colour {
  Axis axis;
  const char* name;
};
constexpr Colour kColoursOfAxes[] = {{Axis::usual, "usual"},       {Axis::neighbours, "neighbours"},
                                     {Axis::rays, "rays"},         {Axis::interval, "visibility interval"},
                                     {Axis::step, "step"},         {Axis::several, "several at once"},
                                     {Axis::substeps, "sub-steps"}};

std::size_t colour_of(Axis axis) {
  std::size_t i = 0;
  for (const Colour& colour : kColoursOfAxes) {
    if (colour.axis == axis) return i;
    ++i;
  }
  return 0;
}

std::string part(const std::optional<front::Errors>& errors) {
  return errors ? percent_text(errors->largest()) : "–";
}
std::string speed(const std::optional<double>& cells_per_second) {
  return cells_per_second ? speed_text(*cells_per_second) : "–";
}

std::string hover(const Measured& point) {
  std::string text = front::text_of(point.choice);
  const auto add = [&](const char* what, const std::optional<front::Errors>& errors) {
    if (errors) text += fmt::format("\n{} error {}", what, percent_text(errors->largest()));
  };
  add("whole", point.whole);
  add("model", point.model);
  add("arithmetic", point.arithmetic);
  add("grid", point.grid);
  text += fmt::format("\n{} bits a cell\n{} Mcells/s", point.cost.state_bits,
                      speed_text(point.cost.cells_per_second));
  if (point.twin) return text + fmt::format(" by the twin, {:.2f} x its u16 dithered", point.cost.over_twin);
  return text + fmt::format(" by the engine; baseline {}\n{} a run",
                            speed(point.cost.baseline_cells_per_second),
                            seconds_text(*point.cost.run_seconds));
}

std::string legend(const std::vector<std::pair<std::size_t, std::string>>& entries) {
  std::string out;
  for (const auto& [colour, name] : entries)
    out += fmt::format("<span><i class=\"b{}\"></i>{}</span>", colour, escaped(name));
  return "<div class=\"legend\">" + out + "</div>";
}

std::string figure(const FrontChart& chart, const std::string& key, const std::string& below) {
  return fmt::format("<figure><figcaption>{}</figcaption>{}{}{}</figure>\n", escaped(chart.title), key,
                     front_svg(chart), below);
}

std::string settings_figure(const Swept& swept) {
  FrontChart chart{"Time of a run against its whole error",
                   "time of the whole run, seconds (one thread)",
                   "whole error, %",
                   {}};
  const front::Plotted plotted = front::run_time_against_whole_error(swept);
  std::vector<std::pair<std::size_t, std::string>> key;
  for (std::size_t i = 0; i < plotted.places.size(); ++i) {
    const Measured& point = swept.points[plotted.point[i]];
    const std::size_t colour = colour_of(point.choice.axis);
    chart.dots.push_back({plotted.places[i], hover(point), "", colour, point.choice.axis == Axis::usual});
    if (std::none_of(key.begin(), key.end(), [&](const auto& k) { return k.first == colour; }))
      key.emplace_back(colour, kColoursOfAxes[colour].name);
  }
  std::string list = "<ol>";
  int number = 0;
  for (const std::size_t i : front::undominated(plotted.places)) {
    chart.dots[i].label = std::to_string(++number);
    const Measured& point = swept.points[plotted.point[i]];
    list += fmt::format("<li>{}: {}, {}</li>", escaped(front::text_of(point.choice)),
                        percent_text(plotted.places[i].error), seconds_text(plotted.places[i].cost));
  }
  return figure(chart, legend(key), list + "</ol>");
}

std::string formats_figure(const Swept& swept) {
  FrontChart chart{
      "Bits of state against arithmetic error", "bits of state per cell", "arithmetic error, %", {}, false};
  const front::Plotted plotted = front::bits_against_arithmetic_error(swept);
  if (plotted.places.empty()) return "";
  for (std::size_t i = 0; i < plotted.places.size(); ++i) {
    const Measured& point = swept.points[plotted.point[i]];
    const front::Arithmetic a = point.choice.setting.arithmetic;
    const std::size_t colour = front::is_real(a.number) ? 3 : static_cast<std::size_t>(a.rounding);
    const bool named = front::is_real(a.number) || a.rounding == front::Rounding::truncate;
    const std::string name = front::name_of(a);
    chart.dots.push_back({plotted.places[i], hover(point), named ? name.substr(0, name.find(' ')) : "",
                          colour, a == front::kEngine});
  }
  return figure(chart, legend({{0, "truncated"}, {1, "nearest"}, {2, "dithered"}, {3, "real"}}),
                "<p class=\"soft\">An exact 0 lies at the lower end. The ring is the engine's format.</p>");
}

std::string grid_figure(const Swept& swept) {
  FrontChart chart{"Grids: time of a run against the grid's error",
                   "time of the whole run, seconds (one thread)",
                   "grid error, %",
                   {}};
  const front::Plotted plotted = front::run_time_against_grid_error(swept);
  for (std::size_t i = 0; i < plotted.places.size(); ++i) {
    const Measured& point = swept.points[plotted.point[i]];
    chart.dots.push_back({plotted.places[i], hover(point),
                          fmt::format("grid {:g}", point.choice.setting.grid), 1,
                          point.choice.axis == Axis::usual});
  }
  return figure(chart, legend({{1, fmt::format("beside grid {:g}, same setting", swept.finest_grid.grid)}}),
                "<p class=\"soft\">Grid 1 has as many cells as the scene's file says.</p>");
}

std::string pick_card(const Swept& swept) {
  std::string settings, formats;
  for (const front::Pick& pick : front::picks_of_settings(swept))
    settings += fmt::format("<dt>{}</dt><dd>{}</dd>", pick.bound, escaped(pick_text(pick)));
  if (!swept.subject->viscous)
    for (const front::Pick& pick : front::picks_of_formats(swept))
      formats += fmt::format("<dt>{}</dt><dd>{}</dd>", pick.bound, escaped(format_pick_text(pick)));
  return fmt::format(
      "<section class=\"card\"><h3><a href=\"#{}\">{}</a></h3><h4>Setting, for a whole error "
      "of</h4><dl>{}</dl>{}"
      "</section>\n",
      swept.subject->scene, title_of(swept), settings,
      formats.empty() ? "" : "<h4>Number format, for an arithmetic error of</h4><dl>" + formats + "</dl>");
}

std::string table_row(const Measured& point) {
  const auto number = [](const std::string& text) { return "<td class=\"n\">" + text + "</td>"; };
  return "<tr><td>" + escaped(front::text_of(point.choice)) + "<small>" + front::name_of(point.choice.axis) +
         (point.twin ? ", twin" : "") + "</small></td>" + number(part(point.arithmetic)) +
         number(part(point.model)) + number(part(point.whole)) + number(part(point.grid)) +
         number(std::to_string(point.cost.state_bits)) +
         number(point.cost.run_seconds ? seconds_text(*point.cost.run_seconds) : "–") +
         number(speed_text(point.cost.cells_per_second)) +
         number(speed(point.cost.baseline_cells_per_second)) + "</tr>\n";
}

std::string scene_card(const Swept& swept) {
  std::string rows;
  for (const Measured& point : swept.points) rows += table_row(point);
  return fmt::format(
      "<section class=\"card\" id=\"{}\"><h3>{}</h3><p>{}</p><div class=\"charts\">{}{}{}</div>"
      "<details><summary>All {} points</summary><div class=\"rows many\"><table><tr><th></th>"
      "<th class=\"n\">arithmetic</th><th class=\"n\">model</th><th class=\"n\">whole</th><th "
      "class=\"n\">grid</th>"
      "<th class=\"n\">bits</th><th class=\"n\">a run</th><th class=\"n\">Mcells/s</th>"
      "<th class=\"n\">baseline</th></tr>\n{}</table></div></details></section>\n",
      swept.subject->scene, title_of(swept), escaped(usual_text(swept)), settings_figure(swept),
      formats_figure(swept), grid_figure(swept), swept.points.size(), rows);
}

std::string tally(const std::string& number, const std::string& what) {
  return fmt::format("<div><b>{}</b><span>{}</span></div>", number, what);
}

}  // namespace

std::string html_text(const FrontReport& report) {
  std::string picks, scenes, how;
  for (const Swept& swept : report.swept) {
    picks += pick_card(swept);
    scenes += scene_card(swept);
  }
  for (const char* paragraph : kHowErrorsAreMeasured) how += fmt::format("<p>{}</p>", escaped(paragraph));
  const bool quick = report.extent == front::Extent::quick;
  const std::string body = fmt::format(
      "<h1>Speed against error</h1>\n<p class=\"lead\">How wrong a run is at each setting, and what it "
      "costs. "
      "Take the setting that your error allows.</p>\n<div class=\"tally\">{}{}{}</div>\n"
      "<p class=\"soft\">{}, {} set; the engine is {} on one thread. All on a grid of {:g} cells per cell of "
      "the "
      "scene's file.</p>\n<h2>Which setting to take</h2>\n<div class=\"picks\">{}</div>\n"
      "<h2>The fronts</h2>\n<p class=\"soft\">Lower and further left is better. The line joins the points "
      "that no "
      "other point beats; the ring marks the usual setting. A dot tells its numbers under the "
      "pointer.</p>\n{}"
      "<h2>What the errors are</h2>\n<section class=\"card\">{}</section>\n",
      tally(std::to_string(report.points()), "points measured"), tally(std::to_string(report.axes()), "axes"),
      tally(fmt::format("{:.0f} s", report.seconds), "for all of it"), escaped(report.version),
      quick ? "quick" : "full", escaped(report.implementation), front::usual_setting(report.extent).grid,
      picks, scenes, how);
  return page::document("speed against error", kFrontStyle, body);
}

}  // namespace voxmelt::accuracy
