// The tables here are those of docs/results/performance_picture.md, and that of all drawings.
#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::measure {
namespace {

std::string begin(const char* name, const std::string& head) {
  return fmt::format("<!-- table: {} -->\n{}\n", name, head);
}

std::string_view without_kind(std::string_view workload) {
  return workload.substr(std::string_view("scene:").size());
}

std::string drawing_row(const Drawing& drawing, const DrawingTiming& timing, bool named) {
  std::string text = fmt::format("| {} | {} | {} | {} | {} | {} |",
                                 named ? fmt::format("`{}`", without_kind(drawing.workload)) : std::string(),
                                 cpu::name_of(timing.set), timing.threads, milliseconds(timing.field),
                                 milliseconds(timing.light), milliseconds(timing.unchanged));
  for (const double seconds : timing.draw) text += fmt::format(" {} |", milliseconds(seconds));
  return text + fmt::format(" {} | {} |\n", three_digits(drawing.nanoseconds_per_ray(timing, 0)),
                            timing.threads == 1 ? milliseconds(drawing.encode) : "");
}

// Writes the drawings of the widest set, or all.
std::string drawing_table(const Findings& findings, const char* name, bool all) {
  std::string text = begin(name,
                           "| scene | instruction set | threads | field, ms | light and bricks, ms | nothing "
                           "changed, ms | fast, ms | normal, ms | best, ms | ns per ray | PNG, ms |\n"
                           "|---|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
  for (const Drawing& drawing : findings.drawings) {
    bool named = true;
    for (const DrawingTiming& timing : drawing.timings) {
      if (!all && timing.set != drawing.timings.back().set) continue;
      text += drawing_row(drawing, timing, named);
      named = false;
    }
  }
  return text + "\n";
}

std::string grids_table(const Findings& findings) {
  std::string text =
      begin("grids",
            "| scene | grid | instruction set | fast, ms | normal, ms | times the grid before |\n"
            "|---|---|---|--:|--:|--:|");
  const std::vector<FinerGrid>& grids = findings.finer_grids;
  const std::size_t timings = grids.empty() ? 0 : grids.front().timings.size();
  for (std::size_t t = 0; t < timings; ++t)
    for (std::size_t i = 0; i < grids.size(); ++i) {
      const FinerGrid::Timing& timing = grids[i].timings[t];
      text += fmt::format("| `{}` | {} x {} x {} | {} | {} | {} | {} |\n", without_kind(grids[i].scene),
                          grids[i].grid.x, grids[i].grid.y, grids[i].grid.z, cpu::name_of(timing.set),
                          milliseconds(timing.fast), milliseconds(timing.normal),
                          or_dash(growth_of_normal(grids, i, t)));
    }
  return text + "\n";
}

std::string films_table(const Findings& findings) {
  std::string text = begin("films",
                           "| scene | steps | frames | threads | frames a second | processor ms a frame |\n"
                           "|---|--:|--:|--:|--:|--:|");
  for (const MeltFilm& film : findings.films)
    text += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", film.scene, film.steps, film.frames,
                        film.threads, three_digits(film.frames_per_second()),
                        milliseconds(film.processor_seconds / film.frames));
  return text + "\n";
}

}  // namespace

std::string picture_tables(const Findings& findings) {
  return drawing_table(findings, "drawing", false) + drawing_table(findings, "drawings", true) +
         grids_table(findings) + films_table(findings);
}

}  // namespace voxmelt::measure
