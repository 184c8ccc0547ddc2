#include "report/accuracy/front_text.h"

#include <fmt/format.h>

#include <string>

#include "report/accuracy/report.h"

namespace voxmelt::accuracy {

using front::Measured;

const char* const kHowErrorsAreMeasured[4] = {
    "Four curves are compared, at 12 or 13 equal times of the first half of the scene's steps: the volume of "
    "liquid, the heat, the "
    "height "
    "of the centre of mass above the floor, and the root of the mean square distance of all matter from the "
    "vertical axis. The error of a curve is its mean distance from the reference's curve, over the mean of "
    "that "
    "curve. The error of a run is the largest of the four.",
    "The arithmetic error is that of the run beside the same automaton in double, at the same setting. Its "
    "random choices are the same. The model error is that of the automaton in double at this setting, beside "
    "it in double at the finest setting that was run: a quarter of a step, 26 neighbours, 16 rays, "
    "visibility "
    "at every step. The whole error is that of the run beside that reference. It need not be the sum. The "
    "reference is the finest that was run, not the truth: a run with its step does not see that step's "
    "error. "
    "Under the viscous law, which has no twin, the reference is the engine's run; it is on no front.",
    "All three belong to one grid. What the grid costs is told apart: the engine on a coarser grid beside "
    "the "
    "engine on the finest. Bodies are scaled with the grid, steps are as long as cells.",
    "The twin is a plain program of the paper's law in any number format. In 16 bits with dither it gives "
    "the "
    "engine's bits. Its speeds tell formats apart from each other, and nothing about the engine. Seconds and "
    "cells per second of all other points are the engine's, on one thread. A shorter step lets fall and "
    "spread a "
    "smaller part; a longer one keeps them. The irradiance has 16 bits in all formats."};

std::string seconds_text(double seconds) {
  return fmt::format("{:.{}f} s", seconds, seconds < 0.0995 ? 3 : seconds < 9.95 ? 2 : 1);
}

std::string pick_text(const front::Pick& pick) {
  if (pick.point == nullptr) return "none of the settings measured";
  const Measured& point = *pick.point;
  std::string text =
      fmt::format("{}: error {}", front::text_of(point.choice), percent_text(point.whole->largest()));
  if (point.model)
    text += fmt::format(" (model {}, arithmetic {})", percent_text(point.model->largest()),
                        percent_text(point.arithmetic->largest()));
  return text + fmt::format(", {} a run", seconds_text(*point.cost.run_seconds));
}

std::string format_pick_text(const front::Pick& pick) {
  if (pick.point == nullptr) return "none";
  return fmt::format("{}: error {}, {} bits a cell", front::text_of(pick.point->choice),
                     percent_text(pick.point->arithmetic->largest()), pick.point->cost.state_bits);
}

std::string title_of(const front::Swept& swept) {
  return swept.subject->name + (swept.subject->viscous ? ", viscous law" : "");
}

std::string usual_text(const front::Swept& swept) {
  const Measured& usual = swept.points.front();
  std::string beaten;
  for (const Measured* point : front::faster_and_better(swept))
    beaten += fmt::format("{}{} ({}, {})", beaten.empty() ? "" : "; ", front::text_of(point->choice),
                          percent_text(point->whole->largest()), seconds_text(*point->cost.run_seconds));
  return fmt::format("The usual setting: error {}, {} a run. {}. Other random bits change a run by up to {}.",
                     percent_text(usual.whole->largest()), seconds_text(*usual.cost.run_seconds),
                     beaten.empty() ? "No setting is both faster and better" : "Faster and better: " + beaten,
                     percent_text(swept.seed_error));
}

}  // namespace voxmelt::accuracy
