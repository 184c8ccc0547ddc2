// A plan says which runs a sweep makes: a scene, axes over its keys, and what is kept of each run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "kernel/scene/text/document.h"

namespace voxmelt::app {

inline constexpr std::size_t kMostRuns = 10'000;

// Is one value of an axis.
struct AxisValue {
  std::string text;              // TOML, as after the = of --set
  std::optional<double> number;  // set if it is a number
  scene::Place place;
};

// Is a range of numbers, from which a design takes as many as it needs.
struct AxisRange {
  double from = 0, to = 1;
  bool whole = false;        // both ends are integers
  bool logarithmic = false;  // equal ratios between neighbours
  std::size_t count = 0;     // 0 in a Latin hypercube
};

struct Axis {
  std::string key;  // path.to.key, as of --set
  scene::Place place;
  std::vector<AxisValue> values;   // of a list, or of a range that is resolved
  std::optional<AxisRange> range;  // of a Latin hypercube
};

enum class Design : std::uint8_t { grid, list, latin_hypercube };

// Says what is kept of each run, in words of `voxmelt run`. Empty words are not said.
struct Keep {
  std::optional<std::int64_t> steps, frame_every, write_every;
  std::string size, setting, write, kept;
  std::string checkpoint_every = "60s";
};

struct Plan {
  std::filesystem::path file;
  std::string title;
  std::string scene;  // a file, or a name of `voxmelt list scenes`
  Design design = Design::grid;
  std::size_t runs = 0;    // of a Latin hypercube
  std::uint64_t seed = 1;  // of a Latin hypercube
  std::vector<Axis> axes;  // in the order of the file
  Keep keep;
};

// Reads a plan. docs/sweep.md has its keys. Throws scene::InputError.
Plan read_plan(const std::filesystem::path& file);

// Returns a number of a range, with six digits that count.
AxisValue number_value(double value, bool whole, const scene::Place& place);

// Throws scene::InputError: "plan.toml:3:1: error: axes.heat.gamma<rest>".
[[noreturn]] void fail_axis(const scene::Place& place, const std::string& key, const std::string& rest);

}  // namespace voxmelt::app
