#include "report/runs/sweep_page.h"

#include <fmt/format.h>

#include <cstddef>

#include "report/svg/svg.h"

namespace voxmelt::page {
namespace {

constexpr const char* kRunsStyle = R"(
.runs { display: grid; grid-template-columns: repeat(auto-fill, minmax(150px, 1fr)); gap: 18px 14px; }
.runs a { color: inherit; text-decoration: none; font-size: 12.5px; line-height: 1.4; }
.runs img, .runs .none { width: 100%; aspect-ratio: 4 / 3; object-fit: cover; border-radius: 8px; display: block;
  margin-bottom: 6px; background: var(--faint); border: 1px solid var(--line); }
.runs b { display: block; font-weight: 600; } .runs span { color: var(--soft); display: block; overflow-wrap: anywhere; }
table.all { min-width: 0; table-layout: auto; } table.all th, table.all td { width: auto; padding-right: 18px; white-space: nowrap; }
code { font: 12.5px ui-monospace, "SF Mono", Menlo, "DejaVu Sans Mono", monospace; }
ul { padding-left: 20px; margin: 0 0 14px; } li { margin: 4px 0; overflow-wrap: anywhere; }
)";

std::string tally(const char* css, const std::string& number, const std::string& what) {
  return fmt::format("<div><b class=\"{}\">{}</b><span>{}</span></div>", css, number, what);
}

std::string duration_text(double seconds) {
  if (seconds < 100) return fmt::format("{:.1f} s", seconds);
  if (seconds < 6000) return fmt::format("{:.0f} min", seconds / 60);
  return fmt::format("{:.1f} h", seconds / 3600);
}

std::string end_of(const std::string& key) { return key.substr(key.rfind('.') + 1); }

double liquid_percent(const SweepRun& run) {
  const double all = run.solid + run.liquid;
  return all > 0 ? 100 * run.liquid / all : 0;
}

std::string folder_of(const SweepRun& run) { return "runs/" + escaped(run.name); }

std::string values_text(const SweepPage& page, const SweepRun& run) {
  std::string text;
  for (std::size_t i = 0; i < page.axes.size(); ++i)
    text += (text.empty() ? "" : ", ") + end_of(page.axes[i]) + " " + run.values[i];
  return escaped(text);
}

std::string picture(const SweepPage& page, const SweepRun& run) {
  const std::string image = run.picture.empty() ? std::string("<div class=\"none\"></div>")
                                                : fmt::format("<img loading=\"lazy\" src=\"{}\" alt=\"{}\">",
                                                              escaped(run.picture), values_text(page, run));
  return fmt::format("<a href=\"{}/\">{}<b>{:.0f} % liquid</b><span>{}</span></a>\n", folder_of(run), image,
                     liquid_percent(run), values_text(page, run));
}

std::string table_row(const SweepRun& run) {
  std::string row;
  for (const std::string& value : run.values) row += "<td>" + escaped(value) + "</td>";
  return fmt::format(
      "<tr>{}<td class=\"n\">{:.0f}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{:.1f}</td><td "
      "class=\"n\">{:.1f} %</td><td class=\"n\">{}</td><td><code>{}</code></td></tr>\n",
      row, run.steps, run.solid, run.liquid, liquid_percent(run), duration_text(run.seconds),
      escaped(run.digest));
}

std::string table(const SweepPage& page) {
  std::string head, rows;
  for (const std::string& axis : page.axes) head += "<th>" + escaped(axis) + "</th>";
  for (const SweepRun& run : page.runs)
    if (run.complete) rows += table_row(run);
  return fmt::format(
      "<section class=\"card\"><div class=\"rows\"><table class=\"all\"><tr>{}<th class=\"n\">steps</th><th "
      "class=\"n\">solid</th><th class=\"n\">liquid</th><th class=\"n\">liquid share</th><th "
      "class=\"n\">time</th><th>digest</th></tr>\n{}</table></div></section>\n",
      head, rows);
}

std::string missing(const SweepPage& page) {
  std::string failed, waiting;
  for (const SweepRun& run : page.runs) {
    if (run.complete) continue;
    if (!run.failure.empty())
      failed += fmt::format("<li><b>{}</b>: <span class=\"bad\">{}</span></li>\n", values_text(page, run),
                            escaped(run.failure));
    else
      waiting += "<li>" + values_text(page, run) + "</li>\n";
  }
  std::string text;
  if (!failed.empty()) text += "<h2>Failed</h2>\n<ul>" + failed + "</ul>\n";
  if (!waiting.empty()) text += "<h2>Not complete</h2>\n<ul>" + waiting + "</ul>\n";
  return text;
}

std::string head_of(const SweepPage& page) {
  std::size_t complete = 0, failed = 0;
  double seconds = 0;
  for (const SweepRun& run : page.runs) {
    complete += run.complete ? 1 : 0;
    failed += !run.complete && !run.failure.empty() ? 1 : 0;
    seconds += run.seconds;
  }
  std::string axes;
  for (const std::string& axis : page.axes) axes += (axes.empty() ? "" : ", ") + axis;
  return fmt::format(
      "<h1>{}</h1>\n<p class=\"lead\">Runs of the scene <i>{}</i> that differ in {}.</p>\n<div "
      "class=\"tally\">{}{}{}</div>\n<p class=\"soft\"><a href=\"table.csv\">table.csv</a> has every number "
      "of the complete runs.</p>\n",
      escaped(page.title), escaped(page.scene), escaped(axes),
      tally(complete == page.runs.size() ? "good" : "", fmt::format("{} of {}", complete, page.runs.size()),
            "runs are complete"),
      failed > 0 ? tally("bad", std::to_string(failed), "failed") : "",
      tally("", duration_text(seconds), "of all runs together"));
}

}  // namespace

std::string sweep_html(const SweepPage& page) {
  std::string body = head_of(page) + missing(page);
  std::string charts, pictures;
  for (const Chart& chart : sweep_charts(page)) charts += chart_figure(chart);
  for (const SweepRun& run : page.runs)
    if (run.complete) pictures += picture(page, run);
  if (!charts.empty())
    body +=
        "<h2>How they differ</h2>\n<section class=\"card\"><p>A dot is a run, and a line joins the means "
        "of runs with the same colour.</p><div class=\"charts\">" +
        charts + "</div></section>\n";
  if (!pictures.empty()) {
    body += "<h2>The last picture of each run</h2>\n<div class=\"runs\">" + pictures + "</div>\n";
    body += "<h2>Every run</h2>\n" + table(page);
  }
  return document(page.title, kRunsStyle, body);
}

}  // namespace voxmelt::page
