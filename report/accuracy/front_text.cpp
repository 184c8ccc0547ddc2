#include "report/accuracy/front_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "report/accuracy/report.h"

namespace voxmelt::accuracy {
namespace {

using front::Axis;
using front::Measured;
using front::Pick;
using front::Swept;

std::vector<std::string> row_of(std::initializer_list<std::string_view> cells) {
  return {cells.begin(), cells.end()};
}

std::vector<std::string> pick_row(const Swept& swept, const Pick& pick) {
  return row_of({title_of(swept), fmt::format("{:g} %", 100 * pick.bound),
                 pick.none ? "none" : front::words_of(pick.setting), axes_text(pick.without),
                 percent_text(pick.sum) + (pick.curves_alone ? " *" : ""),
                 pick.none ? "-" : seconds_text(pick.seconds), seconds_text(swept.usual_seconds)});
}

std::vector<std::string> grid_row(const Swept& swept, const Measured& point) {
  return row_of({title_of(swept), "", front::text_of(point.axis, point.setting), "",
                 percent_text(point.difference.error()), seconds_text(point.seconds),
                 seconds_text(swept.usual_seconds)});
}

// Tells if no step keeps any bound under the paper's law.
bool step_matters(const Swept& swept) {
  return !swept.subject->viscous && std::all_of(swept.picks.begin(), swept.picks.end(), [](const Pick& pick) {
    return std::find(pick.without.begin(), pick.without.end(), Axis::step) != pick.without.end();
  });
}

bool has_star(const Swept& swept) {
  return std::any_of(swept.picks.begin(), swept.picks.end(),
                     [](const Pick& pick) { return pick.curves_alone && !pick.none; });
}

constexpr const char* kAxesText =
    "One axis changes at a time, and all else is as usual. A setting's error is its distance from the "
    "finest setting of its own axis: {}, 16 rays per face, shadows at every step, 1024 sub-steps. For each "
    "axis the table takes the cheapest setting whose error keeps the bound. All of these are run together. "
    "An axis misses the bound if no setting of it keeps it. Then it stays as usual. Where nothing else is "
    "left the table says none. The sum has the errors along all axes, and those of one run may add up to it.";
constexpr const char* kTimeText =
    "Seconds are processor time of one thread. The full set takes the least of three rounds, but runs what "
    "takes more than 10 s once. Other work on the machine lengthens all of them.";
constexpr const char* kUsualText =
    "Usual is what a scene has whose file says nothing: visibility_every = 1, rays_per_face = 1, "
    "substeps_max = 64, stages_max = 1. The files of the viscous scenes say substeps_max = 8. In a step x 2 "
    "all rates per step are doubled, and half as many steps are done. In a step 1/2 half as much falls and "
    "spreads, too. No step below {} was run, and no grid finer than the usual one. So the errors of steps "
    "and of grids are at least those that are told.";
constexpr const char* kErrorText =
    "Four curves over time are compared, at 12 or 13 equal times: the volume of liquid, the heat, the height "
    "of the centre of mass, and the root of the mean square distance from the vertical axis. The error of a "
    "curve is its mean distance from the reference's, over the mean of that. The map holds the liquid above "
    "each square of 4 x 4 cells of the scene's file at the end. Its error is the part of the liquid that "
    "lies elsewhere. The error of a setting is the largest of the five.";
constexpr const char* kNeighboursText =
    "More neighbours are another stencil, not a finer one. They differ from 6 by so much, and no pick takes "
    "them. Conduction is the same under both laws, so they are tried under the paper's alone.";
constexpr const char* kPaperText =
    "Under the paper's law half a step flows otherwise, and no step was run from which on it does not. There "
    "the length of a step is a part of the model, so look at the other axes.";
constexpr const char* kStarText =
    "A star: other random bits move more of the map than the bound, so the curves alone are judged. Where "
    "they change the curves by more than the bound, no setting is judged.";

}  // namespace

std::string axes_text(const std::vector<Axis>& axes) {
  std::string text;
  for (const Axis axis : axes) text += fmt::format("{}{}", text.empty() ? "" : ", ", front::name_of(axis));
  return text;
}

FrontTable picks_table(const FrontReport& report) {
  FrontTable table{
      {"scene", "each axis at most", "setting", "axes that miss it", "errors, summed", "a run", "usual run"},
      4};
  for (const Swept& swept : report.swept) {
    for (const Pick& pick : swept.picks) table.rows.push_back(pick_row(swept, pick));
    for (const Measured& point : swept.points)
      if (point.axis == Axis::grid && !point.reference) table.rows.push_back(grid_row(swept, point));
  }
  return table;
}

FrontTable points_table(const Swept& swept) {
  FrontTable table{{"axis", "setting", "curves", "map", "a run"}, 2};
  for (const Measured& point : swept.points) {
    const bool usual = point.setting == swept.usual;
    table.rows.push_back(row_of(
        {front::name_of(point.axis), front::text_of(point.axis, point.setting) + (usual ? " (usual)" : ""),
         point.reference ? "reference" : percent_text(point.difference.curves.largest()),
         point.reference ? "" : percent_text(point.difference.map), seconds_text(point.seconds)}));
  }
  return table;
}

FrontTable formats_table(const FrontReport& report) {
  FrontTable table{{"format", "bits a cell"}, 1};
  for (const Swept& swept : report.swept) {
    if (swept.formats.empty()) continue;
    table.head.push_back(title_of(swept));
    if (table.rows.empty())
      for (const front::Format& format : swept.formats)
        table.rows.push_back(row_of({front::name_of(format.arithmetic), std::to_string(format.state_bits)}));
    for (std::size_t i = 0; i < swept.formats.size(); ++i)
      table.rows[i].push_back(percent_text(swept.formats[i].error));
  }
  return table;
}

std::string seconds_text(double seconds) {
  return fmt::format("{:.{}f} s", seconds,
                     seconds < 0.0995 ? 3
                     : seconds < 9.95 ? 2
                     : seconds < 99.5 ? 1
                                      : 0);
}

std::string title_of(const Swept& swept) {
  return swept.subject->name + (swept.subject->viscous ? ", viscous law" : "");
}

std::string noise_text(const Swept& swept) {
  if (swept.subject->viscous) return "The viscous law draws no random bits.";
  return fmt::format("Other random bits change the curves by up to {}, and the map by up to {}.",
                     percent_text(swept.noise.curves), percent_text(swept.noise.map));
}

std::string about_text(const FrontReport& report) {
  const bool quick = report.extent == front::Extent::quick;
  const std::string grid =
      quick ? "All runs are on a small grid, of 0.375 cells per cell of the scene's file: they say nothing "
              "about the scene's own size."
            : "All runs are at the scene's own size.";
  return fmt::format(
      "{} points, each for the first half of the scene's steps. {} Written by {}, {} set, {} on one thread.",
      report.points(), grid, report.version, quick ? "quick" : "full", report.implementation);
}

std::vector<std::string> texts_below_picks(const FrontReport& report) {
  const bool quick = report.extent == front::Extent::quick;
  std::vector<std::string> texts;
  texts.push_back(fmt::format(kAxesText, quick ? "half a step" : "a quarter of a step"));
  texts.push_back(fmt::format(kUsualText, quick ? "1/2" : "1/4"));
  texts.emplace_back(kErrorText);
  texts.emplace_back(kTimeText);
  texts.emplace_back(kNeighboursText);
  if (std::any_of(report.swept.begin(), report.swept.end(), step_matters)) texts.emplace_back(kPaperText);
  if (std::any_of(report.swept.begin(), report.swept.end(), has_star)) texts.emplace_back(kStarText);
  return texts;
}

const char* const kFormatsText =
    "The twin, a plain program of the paper's law, computes in any number format. Here are its curves "
    "beside those in double, at the same setting and with the same random choices. Its grid is small, of "
    "0.375 cells per cell of the scene's file. The engine computes in u16, dithered.";

}  // namespace voxmelt::accuracy
