// The functions here choose the settings of a sweep.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "accuracy/front/sweep.h"

namespace voxmelt::accuracy::front {
namespace {

constexpr int kMostRays = 16;

std::string times(double value, const char* what) {
  return value < 1 ? fmt::format("{} 1/{:g}", what, 1 / value) : fmt::format("{} x {:g}", what, value);
}

// Adds settings that are cheaper and finer on several axes at once, up to the setting of the reference.
void add_several(const Subject& subject, Extent extent, std::vector<Choice>& all) {
  const auto add = [&](double step, int neighbours, int rays, int interval) {
    Choice choice{Axis::several, usual_setting(extent)};
    Setting& s = choice.setting;
    s.step = step;
    s.neighbours = neighbours;
    if (subject.radiates) {
      s.rays = rays;
      s.interval = interval;
    }
    if (subject.viscous && step < 1) s.substeps_max = 64;
    all.push_back(choice);
  };
  if (extent == Extent::quick) return add(0.5, 26, kMostRays, 1);
  if (subject.radiates) {
    add(2, 6, 1, 16);
    add(1, 26, kMostRays, 1);
    add(0.5, 6, 4, 4);
    add(0.25, 6, 4, 4);
  }
  add(0.5, 26, kMostRays, 2);
  add(0.25, 26, kMostRays, 1);
}

}  // namespace

const char* name_of(Axis axis) {
  switch (axis) {
    case Axis::usual:
      return "usual";
    case Axis::format:
      return "format";
    case Axis::rounding:
      return "rounding";
    case Axis::neighbours:
      return "neighbours";
    case Axis::rays:
      return "rays";
    case Axis::interval:
      return "interval";
    case Axis::step:
      return "step";
    case Axis::substeps:
      return "substeps";
    case Axis::grid:
      return "grid";
    case Axis::several:
      break;
  }
  return "several";
}

std::string text_of(const Choice& choice) {
  const Setting& s = choice.setting;
  switch (choice.axis) {
    case Axis::usual:
      return "the usual setting";
    case Axis::format:
    case Axis::rounding:
      return name_of(s.arithmetic);
    case Axis::neighbours:
      return fmt::format("{} neighbours", s.neighbours);
    case Axis::rays:
      return fmt::format("{} rays per face", s.rays);
    case Axis::interval:
      return s.interval == 1 ? "visibility every step" : fmt::format("visibility every {} steps", s.interval);
    case Axis::step:
      return times(s.step, "step");
    case Axis::substeps:
      return fmt::format("{} sub-step{}", s.substeps, s.substeps == 1 ? "" : "s");
    case Axis::grid:
      return fmt::format("grid {:g}", s.grid);
    case Axis::several:
      break;
  }
  const Setting usual;
  std::string text = s.step == usual.step ? "" : times(s.step, "step");
  const auto and_also = [&](bool differs, const std::string& what) {
    if (differs) text += fmt::format("{}{}", text.empty() ? "" : ", ", what);
  };
  and_also(s.neighbours != usual.neighbours, fmt::format("{} neighbours", s.neighbours));
  and_also(s.rays != usual.rays, fmt::format("{} rays", s.rays));
  and_also(s.interval != usual.interval, fmt::format("visibility every {}", s.interval));
  and_also(s.substeps_max != usual.substeps_max, fmt::format("up to {} sub-steps", s.substeps_max));
  return text;
}

Setting usual_setting(Extent extent) { return {.grid = extent == Extent::quick ? 0.25 : 0.375}; }

Setting reference_of(const Subject& subject, Extent extent) {
  const bool quick = extent == Extent::quick;
  Setting finest = usual_setting(extent);
  finest.neighbours = 26;
  finest.step = quick ? 0.5 : 0.25;
  if (subject.radiates) {
    finest.rays = kMostRays;
    finest.interval = 1;
  }
  finest.substeps_max = 64;
  return finest;
}

Setting finest_grid(Extent extent) {
  Setting setting = usual_setting(extent);
  setting.grid = extent == Extent::quick ? 0.5 : 1;
  return setting;
}

std::vector<Choice> choices(const Subject& subject, Extent extent) {
  const Setting usual = usual_setting(extent);
  std::vector<Choice> all{{Axis::usual, usual}};
  const auto add = [&](Axis axis, const auto& change) {
    Choice choice{axis, usual};
    change(choice.setting);
    all.push_back(choice);
  };
  const bool quick = extent == Extent::quick;
  if (!subject.viscous)
    for (const Arithmetic arithmetic : all_arithmetics()) {
      const bool whole = !is_real(arithmetic.number);
      if (quick && whole && arithmetic.rounding != kEngine.rounding && arithmetic.number != kEngine.number)
        continue;
      add(arithmetic.number == kEngine.number ? Axis::rounding : Axis::format,
          [&](Setting& s) { s.arithmetic = arithmetic; });
    }
  for (const int n : quick ? std::vector{26} : std::vector{18, 26})
    add(Axis::neighbours, [&](Setting& s) { s.neighbours = n; });
  if (subject.radiates) {
    for (const int n : quick ? std::vector{kMostRays} : std::vector{4, kMostRays})
      add(Axis::rays, [&](Setting& s) { s.rays = n; });
    for (const int n : quick ? std::vector{2, 32} : std::vector{1, 2, 4, 16, 32})
      add(Axis::interval, [&](Setting& s) { s.interval = n; });
  }
  for (const double step : quick ? std::vector{2.} : std::vector{2., 0.5, 0.25})
    add(Axis::step, [&](Setting& s) { s.step = step; });
  if (subject.viscous)
    for (const int n : quick ? std::vector{1} : std::vector{1, 2, 4, 8, 16})
      add(Axis::substeps, [&](Setting& s) { s.substeps = n; });
  for (const double grid : quick ? std::vector{0.375} : std::vector{0.25, 0.5, 0.75})
    add(Axis::grid, [&](Setting& s) { s.grid = grid; });
  add_several(subject, extent, all);
  return all;
}

}  // namespace voxmelt::accuracy::front
