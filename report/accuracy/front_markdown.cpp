// The file docs/results/front.md has the front in words and tables, for readers of the sources.
#include <fmt/format.h>

#include <optional>
#include <string>

#include "accuracy/front/words.h"
#include "report/accuracy/front.h"
#include "report/accuracy/front_text.h"
#include "report/accuracy/report.h"
#include "report/accuracy/wrapped.h"

namespace voxmelt::accuracy {
namespace {

using front::Measured;
using front::Swept;

std::string part(const std::optional<front::Errors>& errors) {
  return errors ? percent_text(errors->largest()) : "-";
}

std::string picks_table(const FrontReport& report) {
  std::string out = "| scene | whole error | setting |\n|---|---|---|\n";
  for (const Swept& swept : report.swept)
    for (const front::Pick& pick : front::picks_of_settings(swept))
      out += fmt::format("| {} | {} | {} |\n", title_of(swept), pick.bound, pick_text(pick));
  out += "\n| scene | arithmetic error | number format |\n|---|---|---|\n";
  for (const Swept& swept : report.swept)
    if (!swept.subject->viscous)
      for (const front::Pick& pick : front::picks_of_formats(swept))
        out += fmt::format("| {} | {} | {} |\n", title_of(swept), pick.bound, format_pick_text(pick));
  return out;
}

std::string points_table(const Swept& swept) {
  std::string out =
      "| setting | axis | arithmetic | model | whole | grid | bits | a run | Mcells/s | baseline |\n"
      "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const Measured& point : swept.points) {
    const auto& baseline = point.cost.baseline_cells_per_second;
    out +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} | {} | {}{} | {} |\n", front::text_of(point.choice),
                    front::name_of(point.choice.axis), part(point.arithmetic), part(point.model),
                    part(point.whole), part(point.grid), point.cost.state_bits,
                    point.cost.run_seconds ? seconds_text(*point.cost.run_seconds) : "-",
                    speed_text(point.cost.cells_per_second), point.twin ? " (twin)" : "",
                    baseline ? speed_text(*baseline) : "-");
  }
  return out;
}

}  // namespace

std::string markdown_text(const FrontReport& report) {
  std::string out = fmt::format(
      "<!-- Written by `voxmelt accuracy --front`; accuracy/write_front.sh puts it here. -->\n"
      "# Speed against error\n\n{}\n\n",
      wrapped(fmt::format("{} points along {} axes, on a grid of {:g} cells per cell of the scene's file. "
                          "Written by {}, {} set, {} on one thread.",
                          report.points(), report.axes(), front::usual_setting(report.extent).grid,
                          report.version, report.extent == front::Extent::quick ? "quick" : "full",
                          report.implementation)));
  out +=
      "Run it yourself: `voxmelt accuracy --front --out out/front` writes this and a page with pictures.\n\n";
  out += fmt::format("## Which setting to take\n\n{}\n## What the errors are\n", picks_table(report));
  for (const char* paragraph : kHowErrorsAreMeasured) out += fmt::format("\n{}\n", wrapped(paragraph));
  for (const Swept& swept : report.swept)
    out +=
        fmt::format("\n## {}\n\n{}\n\n{}", title_of(swept), wrapped(usual_text(swept)), points_table(swept));
  return out;
}

}  // namespace voxmelt::accuracy
