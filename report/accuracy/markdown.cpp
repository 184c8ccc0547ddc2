// The file docs/results/accuracy.md has the tables of the page, for readers of the sources.
#include <fmt/format.h>

#include <cstddef>
#include <sstream>
#include <string>

#include "report/accuracy/report.h"
#include "report/accuracy/wrapped.h"

namespace voxmelt::accuracy {
namespace {

constexpr std::size_t kColumns = 96;

std::string bar_free(std::string text) {
  for (char& c : text)
    if (c == '|') c = '/';
  return text;
}

std::string list_item(const std::string& text) {
  std::string out = "- ";
  for (const char c : wrapped(text)) out += c == '\n' ? std::string("\n  ") : std::string(1, c);
  return out + '\n';
}

std::string table_row(const Row& row) {
  const auto& baseline = row.speed.baseline_cells_per_second;
  return fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", bar_free(row.setting),
                     bar_free(row.quantity), number_text(row.value), number_text(row.exact), error_text(row),
                     gate_text(row),
                     !row.gate      ? ""
                     : row.passed() ? "passed"
                                    : "**missed**",
                     row.speed.cells_per_second > 0 ? speed_text(row.speed.cells_per_second) : "-",
                     baseline ? speed_text(*baseline) : "-");
}

}  // namespace

std::string wrapped(const std::string& text) {
  std::istringstream words(text);
  std::string out, line, word;
  while (words >> word) {
    if (!line.empty() && line.size() + 1 + word.size() > kColumns) {
      out += line + '\n';
      line.clear();
    }
    line += (line.empty() ? "" : " ") + word;
  }
  return out + line;
}

std::string markdown_text(const Report& report) {
  std::string out = fmt::format(
      "<!-- Written by `voxmelt accuracy`; accuracy/write_accuracy.sh puts it here. -->\n"
      "# Accuracy\n\n"
      "The automaton beside answers that mathematics gives. The arithmetic is exact on every machine,\n"
      "so each error here is of the model. A gate is a bar on the error; a row without one is reported.\n\n"
      "**{} of {} gates passed.** Written by {}, {} set, {} on {} thread{}.\n\n"
      "Speeds are in million cells of the grid per second. The baseline is the paper's program, plainly\n"
      "written, on the same start. For a scene of the viscous law it runs the paper's law.\n\n"
      "Run it yourself: `voxmelt accuracy --quick`, or `voxmelt accuracy --out out/accuracy` for the page\n"
      "with pictures. `--case NAME` runs one case, and `--set KEY=VALUE` changes its scene, to see an\n"
      "error appear.\n",
      report.gates() - report.missed(), report.gates(), report.version, report.quick ? "quick" : "full",
      report.implementation, report.threads, report.threads == 1 ? "" : "s");
  std::string family;
  for (const Found& found : report.found) {
    if (found.one->family != family) out += fmt::format("\n## {}\n", family = found.one->family);
    out +=
        fmt::format("\n### {}: {}\n\n{}\n\n", found.one->name, found.one->title, wrapped(found.one->about));
    out +=
        "| setting | quantity | value | exact | error | gate | | Mcells/s | baseline |\n"
        "|---|---|---:|---:|---:|---:|---|---:|---:|\n";
    for (const Row& row : found.outcome.rows) out += table_row(row);
    std::string notes;
    for (const Row& row : found.outcome.rows)
      if (!row.note.empty()) notes += list_item(row.setting + ": " + row.note);
    if (!notes.empty()) out += "\n" + notes;
  }
  return out;
}

}  // namespace voxmelt::accuracy
