// The page shows each question, every answer beside the exact one, and pictures of both.
#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "report/accuracy/svg.h"
#include "report/svg/svg.h"

namespace voxmelt::accuracy {
namespace {

using page::escaped;

// Writes true minus signs.
std::string typeset(const std::string& number) {
  std::string out;
  for (const char c : number) out += c == '-' ? std::string("−") : std::string(1, c);
  return out;
}

std::string table_row(const Row& row) {
  const std::string verdict = !row.gate      ? "<span class=\"soft\">reported</span>"
                              : row.passed() ? "<span class=\"good\">passed</span>"
                                             : "<span class=\"bad\">missed</span>";
  const auto& baseline = row.speed.baseline_cells_per_second;
  return fmt::format(
      "<tr><td>{}<small>{}{}</small></td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n e "
      "{}\">{}</td>"
      "<td class=\"n\">{}</td><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td "
      "class=\"n\">{}</td></tr>\n",
      escaped(row.setting), escaped(row.quantity), row.note.empty() ? "" : "; " + escaped(row.note),
      typeset(number_text(row.value)), typeset(number_text(row.exact)), row.passed() ? "" : "bad",
      typeset(error_text(row)), row.gate ? "± " + gate_text(row) : "", verdict,
      row.speed.cells_per_second > 0 ? speed_text(row.speed.cells_per_second) : "–",
      baseline ? speed_text(*baseline) : "–",
      row.speed.state_bits > 0 ? std::to_string(row.speed.state_bits) : "–");
}

std::string pill(const Outcome& outcome) {
  const auto gates = std::count_if(outcome.rows.begin(), outcome.rows.end(),
                                   [](const Row& r) { return r.gate.has_value(); });
  const auto missed =
      std::count_if(outcome.rows.begin(), outcome.rows.end(), [](const Row& r) { return !r.passed(); });
  if (gates == 0) return "<span class=\"pill soft\">reported</span>";
  if (missed == 0) return fmt::format("<span class=\"pill good\">{0} of {0}</span>", gates);
  return fmt::format("<span class=\"pill bad\">{} of {}</span>", gates - missed, gates);
}

std::string card(const Found& found) {
  std::string rows, charts;
  for (const Row& row : found.outcome.rows) rows += table_row(row);
  for (const Chart& chart : found.outcome.charts) charts += page::chart_figure(chart_of(chart));
  return fmt::format(
      "<section class=\"card\" id=\"{}\"><div class=\"head\"><h3>{}</h3>{}</div>\n<p>{}</p>\n<div "
      "class=\"rows\"><table>"
      "<tr><th></th><th class=\"n\">value</th><th class=\"n\">exact</th><th class=\"n\">error</th><th "
      "class=\"n\">gate</th><th></th>"
      "<th class=\"n\">Mcells/s</th><th class=\"n\">baseline</th><th "
      "class=\"n\">bits</th></tr>\n{}</table></div>\n"
      "<div class=\"charts\">{}</div></section>\n",
      found.one->name, escaped(found.one->title), pill(found.outcome), escaped(found.one->about), rows,
      charts);
}

std::string tally(const char* css, const std::string& number, const std::string& what) {
  return fmt::format("<div><b class=\"{}\">{}</b><span>{}</span></div>", css, number, what);
}

}  // namespace

std::string html_text(const Report& report) {
  double seconds = 0;
  for (const Found& found : report.found) seconds += found.seconds;
  std::string body = fmt::format(
      "<h1>How well voxmelt does physics</h1>\n"
      "<p class=\"lead\">The automaton beside answers that mathematics gives: conduction and melting, light, "
      "liquids that "
      "spread, run down and level. Its arithmetic is exact, so every error here is of the model.</p>\n"
      "<div class=\"tally\">{}{}{}</div>\n",
      tally("good", std::to_string(report.gates() - report.missed()), "gates passed"),
      tally(report.missed() > 0 ? "bad" : "good", std::to_string(report.missed()), "gates missed"),
      tally("", fmt::format("{:.0f} s", seconds), report.quick ? "for the quick set" : "for the full set"));
  body += fmt::format(
      "<p class=\"soft\">{}; {} on {} thread{}{}. Speeds are million cells of the grid per second; baseline "
      "is the paper's "
      "program, plainly written, on the same start. Bits are the state of one cell.</p>\n",
      escaped(report.version), escaped(report.implementation), report.threads, report.threads == 1 ? "" : "s",
      report.sets.empty() ? "" : escaped(fmt::format("; changed by --set {}", fmt::join(report.sets, ", "))));
  body +=
      "<h2>Every error</h2>\n<section class=\"card\"><p>Each dot is an error over its gate. A ring is an "
      "error without a gate, over a tenth of the exact value, or over 0.1 where that is 0. Left of the line "
      "an error is smaller than that bar; the axis is logarithmic.</p>" +
      overview_svg(report) + "</section>\n";
  std::string family;
  for (const Found& found : report.found) {
    if (found.one->family != family)
      body += fmt::format("<h2>{}</h2>\n", escaped(family = found.one->family));
    body += card(found);
  }
  return page::document("accuracy", "", body);
}

}  // namespace voxmelt::accuracy
