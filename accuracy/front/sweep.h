// The sweep tries settings of a scene along each axis. It records the cost and the error of each.
//
//   arithmetic error   of the run, against the twin in double at the same setting
//   model error        of the twin in double, against the reference: the twin in double at the finest setting
//   whole error        of the run, against that reference
//
// All this is on one grid. The grid's own error is told apart. It compares the engine's run with the engine's
// on the finest grid, at the usual setting. It is never laid beside the others.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "accuracy/case.h"
#include "accuracy/front/curves.h"
#include "accuracy/front/subject.h"

namespace voxmelt::accuracy::front {

enum class Axis { usual, format, rounding, neighbours, rays, interval, step, substeps, grid, several };
const char* name_of(Axis axis);

struct Choice {
  Axis axis = Axis::usual;  // axis along which it departs from the usual setting
  Setting setting;
};
std::string text_of(const Choice& choice);  // "every 16 steps", "u8 nearest"

struct Cost {
  int state_bits = 0;                 // per cell
  std::optional<double> run_seconds;  // the whole run, by the engine; nothing if only the twin can run it
  double cells_per_second = 0;        // speed of the engine, else of the twin
  std::optional<double> baseline_cells_per_second{};  // the paper's program, from the middle of the run
  double over_twin = 0;  // the twin's speed over its speed in the engine's format
};

struct Measured {
  Choice choice;
  bool twin = false;                            // computed by the twin alone
  std::optional<Errors> arithmetic{}, model{};  // nothing under the viscous law, which has no twin
  std::optional<Errors> whole{};                // nothing on another grid
  std::optional<Errors> grid{};                 // along the axis of grids only
  Cost cost{};
};

struct Swept {
  const Subject* subject = nullptr;
  Setting reference, finest_grid;
  double seed_error = 0;  // largest error between runs that differ in nothing but their random bits
  std::vector<Measured> points;
};

enum class Extent { quick, full };

// Returns the choices of a subject, the usual one first.
std::vector<Choice> choices(const Subject& subject, Extent extent);
Setting usual_setting(Extent extent);
Setting reference_of(const Subject& subject, Extent extent);  // the finest on the usual grid
Setting finest_grid(Extent extent);                           // the usual setting on the finest grid

// Calls `told` before each point. The engine runs on one thread.
Swept sweep(const Subject& subject, Extent extent, const Conditions& conditions,
            const std::function<void(const Choice&)>& told);

}  // namespace voxmelt::accuracy::front
