#include "accuracy/front/ladder.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

namespace voxmelt::accuracy::front {
namespace {

constexpr int kMostSubsteps = 1024, kMostStages = 16;

struct SubstepsAndStages {
  int substeps, stages;
};

}  // namespace

const char* name_of(Axis axis) {
  switch (axis) {
    case Axis::step:
      return "step";
    case Axis::rays:
      return "rays";
    case Axis::visibility:
      return "visibility";
    case Axis::viscous:
      return "viscous";
    case Axis::grid:
      return "grid";
    case Axis::neighbours:
      break;
  }
  return "neighbours";
}

Setting usual_setting(Extent extent) { return extent == Extent::quick ? setting_of_formats() : Setting{}; }
Setting setting_of_formats() { return {.grid = 0.375}; }

std::vector<Ladder> ladders(const Subject& subject, Extent extent) {
  const Setting usual = usual_setting(extent);
  const bool quick = extent == Extent::quick;
  std::vector<Ladder> all;
  const auto add = [&](Axis axis, const auto& choices, const auto& choose) {
    Ladder ladder{axis, {}};
    for (const auto& choice : choices) {
      Setting setting = usual;
      choose(setting, choice);
      if (subject.allows(setting)) ladder.settings.push_back(setting);
    }
    all.push_back(std::move(ladder));
  };
  add(Axis::step, quick ? std::vector{2., 1., 0.5} : std::vector{2., 1., 0.5, 0.25},
      [](Setting& s, double step) { s.step = step; });
  if (subject.radiates) {
    add(Axis::rays, quick ? std::vector{1, 16} : std::vector{1, 4, 16},
        [](Setting& s, int rays) { s.rays = rays; });
    add(Axis::visibility, quick ? std::vector{8, 1} : std::vector{32, 8, 4, 2, 1},
        [](Setting& s, int interval) { s.interval = interval; });
  }
  if (subject.viscous) {
    std::vector<SubstepsAndStages> flows{{1, 1}, {1, kMostStages}, {64, 1}, {kMostSubsteps, 1}};
    if (!quick)
      flows = {{1, 1},           {2, 1},           {4, 1},  {8, 1},
               {1, kMostStages}, {4, kMostStages}, {64, 1}, {kMostSubsteps, 1}};
    add(Axis::viscous, flows, [](Setting& s, SubstepsAndStages flow) {
      s.substeps_max = flow.substeps;
      s.stages_max = flow.stages;
    });
  }
  add(Axis::grid, quick ? std::vector{0.25, 0.375} : std::vector{0.5, 0.75, 1.},
      [](Setting& s, double grid) { s.grid = grid; });
  if (subject.viscous) return all;  // conduction is the same under both laws
  add(Axis::neighbours, quick ? std::vector{26, 6} : std::vector{18, 26, 6},
      [](Setting& s, int neighbours) { s.neighbours = neighbours; });
  return all;
}

bool ends_at_reference(Axis axis) { return axis == Axis::visibility || axis == Axis::viscous; }

std::string text_of(Axis axis, const Setting& setting) {
  switch (axis) {
    case Axis::step:
      return setting.step < 1 ? fmt::format("step 1/{:g}", 1 / setting.step)
                              : fmt::format("step x {:g}", setting.step);
    case Axis::rays:
      return fmt::format("rays_per_face = {}", setting.rays);
    case Axis::visibility:
      return fmt::format("visibility_every = {}", setting.interval);
    case Axis::viscous:
      return fmt::format("substeps_max = {}", setting.substeps_max) +
             (setting.stages_max == 1 ? "" : fmt::format(", stages_max = {}", setting.stages_max));
    case Axis::grid:
      return fmt::format("grid {:g}", setting.grid);
    case Axis::neighbours:
      break;
  }
  return fmt::format("neighbours = {}", setting.neighbours);
}

std::string words_of(const Setting& setting) {
  std::string words;
  for (const Axis axis : kPickedAxes)
    if (const std::string text = text_of(axis, setting); text != text_of(axis, Setting{}))
      words += (words.empty() ? "" : ", ") + text;
  return words.empty() ? "the usual setting" : words;
}

}  // namespace voxmelt::accuracy::front
