// The sweep tries settings of a scene, one axis at a time, and records the time and the error of each. Every
// axis has a reference of its own: its finest setting, all else as usual. All runs are the engine's, on one
// thread.
#pragma once

#include <functional>
#include <vector>

#include "accuracy/case.h"
#include "accuracy/front/curves.h"
#include "accuracy/front/ladder.h"
#include "accuracy/front/subject.h"

namespace voxmelt::accuracy::front {

// Says how far one run lies from another.
struct Difference {
  Errors curves{};
  double map = 0;  // part of the liquid that lies elsewhere at the end
  double error() const;
};

struct Measured {
  Axis axis = Axis::step;
  Setting setting;
  bool reference = false;
  Difference difference{};  // from the reference of the axis
  double seconds = 0;       // processor time of the run
};

// Holds what other random bits change, at most.
struct Noise {
  double curves = 0, map = 0;
};

// The twin compares number formats with double at the same setting.
struct Format {
  Arithmetic arithmetic{};
  double error = 0;    // of the curves
  int state_bits = 0;  // per cell
};

// A pick takes the cheapest setting that keeps a bound on each axis.
struct Pick {
  double bound = 0;
  Setting setting{};            // all axes together
  std::vector<Axis> without{};  // axes along which no measured setting keeps the bound: they stay as usual
  bool none = false;            // all that is left is the usual setting, which does not keep it
  double sum = 0;               // of the errors along all axes
  bool curves_alone = false;    // the map's noise exceeds the bound
  double seconds = 0;           // processor time of a run at the setting
};

struct Swept {
  const Subject* subject = nullptr;
  Setting usual;
  double usual_seconds = 0;
  Noise noise{};
  std::vector<Measured> points{};  // axis by axis
  std::vector<Format> formats{};   // none under the viscous law, which has no twin
  std::vector<Pick> picks{};
};

// Calls `told` often, so that it can end the sweep by an exception.
Swept sweep(const Subject& subject, Extent extent, const Conditions& conditions,
            const std::function<void()>& told);

// The formats of a subject of the paper's law.
std::vector<Format> compare_formats(const Subject& subject, Extent extent, const Conditions& conditions);

}  // namespace voxmelt::accuracy::front
