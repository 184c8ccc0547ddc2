// A case puts one question to the automaton that mathematics has answered, and holds what was found.
#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/automaton/step/stepper.h"

namespace voxmelt::accuracy {

// Says how the cases are run. No result but the speeds depends on `implementation` and `threads`.
struct Conditions {
  const step::Implementation* implementation = nullptr;
  int threads = 1;
  bool quick = false;             // small grids and few settings: all cases in a minute of processor time
  std::vector<std::string> sets;  // overrides as of --set, applied to every run's scene after the case's own
  std::filesystem::path scenes;   // folder with the cases' scenes
  bool baseline = true;           // also time the plain baseline
  int threads_always = 0;         // if more than 0, this number of threads, on small grids too
};

struct Speed {
  double cells_per_second = 0;                        // cells of the grid x steps, over seconds of the steps
  std::optional<double> baseline_cells_per_second{};  // the paper's program on the same start
  int state_bits = 0;                                 // per cell, as the run's law needs them
};

enum class Measure { relative, absolute };

// A row holds one number beside its exact value. The gate is an upper bound of |error|. Without one the row
// only reports.
struct Row {
  std::string setting{}, quantity{};
  double value = 0, exact = 0;
  Measure measure = Measure::relative;
  std::optional<double> gate{};
  std::string note{};  // a sentence, if the number needs one
  Speed speed{};

  // Gives value / exact - 1, or value - exact.
  double error() const { return measure == Measure::relative ? value / exact - 1 : value - exact; }
  // Gives what the error is drawn beside: its gate, or a tenth of the exact value (of 1 where that is 0).
  double bar() const {
    if (gate) return *gate;
    return measure == Measure::relative || exact == 0 ? 0.1 : 0.1 * std::abs(exact);
  }
  bool passed() const { return !gate || std::abs(error()) <= *gate; }  // false for a NaN
};

struct Point {
  double x = 0, y = 0;
};

struct Curve {
  std::string name{};
  std::vector<Point> points{};
  bool exact = false;  // exact curves are drawn as lines, measured ones as dots
  bool joined = true;  // few dots are joined by a thin line
};

struct Chart {
  std::string title{}, x_label{}, y_label{};
  std::vector<Curve> curves{};
  bool logarithmic_x = false, logarithmic_y = false;
  std::optional<double> band{};  // the gate of an error, drawn from -band to band
};

struct Outcome {
  std::vector<Row> rows{};
  std::vector<Chart> charts{};
};

struct Case {
  std::string name;    // name for --case
  std::string family;  // a heading of the report
  std::string title;   // one line of `voxmelt list cases`
  std::string about;   // the run, the answer that it is compared with, and what --quick shortens
  Outcome (*measure)(const Conditions&);
};

// Lists all cases in the order of the report.
const std::vector<Case>& all_cases();

}  // namespace voxmelt::accuracy
