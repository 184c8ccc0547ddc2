// All configurations of some axes by the closed forms: how fast each is, what it takes of a device, and
// whether it fits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hwmodel/explore/part_list.h"
#include "hwmodel/explore/schedule.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

// The question.
struct Question {
  rule::Parameters parameters;
  state::Grid grid;
  std::uint32_t first_step = 0;
  std::int64_t steps = 32;
  Device device;
  std::optional<memory::Parameters> memory;  // none: it always answers
  const Irradiance* irradiance = nullptr;    // of the first step; null: dark
  const state::Volume* volume = nullptr;     // before it; null: hw.coded is not tried
};

// The values that are tried. A further axis is a list here and a row below, with its values in axes.cpp and a
// loop in `sweep`. Of tiles there is a number: hw.tile is the narrowest that gives it.
struct Axes {
  std::vector<int> lanes, cascade, substeps, fifo_depth, overlap, coded, tiles{1}, clock_mhz;
  std::optional<int> tile{};  // this hw.tile alone, whatever `tiles` says
};
// The axes that are keys of [hw].
struct Axis {
  std::string_view key;
  std::vector<int> Axes::*values;
};
inline constexpr std::array kAxes{Axis{"lanes", &Axes::lanes},        Axis{"cascade", &Axes::cascade},
                                  Axis{"substeps", &Axes::substeps},  Axis{"fifo_depth", &Axes::fifo_depth},
                                  Axis{"overlap", &Axes::overlap},    Axis{"coded", &Axes::coded},
                                  Axis{"clock_mhz", &Axes::clock_mhz}};
Axes usual_axes(const Question& question);
// The values of hw.tile for these lanes and steps.
std::vector<int> tiles_of(const Axes& axes, const Question& question, const Configuration& hw);
// `sets` are "hw.lanes=8": of that axis this value alone is tried. Throws scene::InputError.
void keep_only(Axes& axes, const std::vector<std::string>& sets);

// What a configuration takes of a device.
struct Taken {
  Amounts amounts{};
  std::int64_t lutram = 0;  // of the LUTs
  double fullest = 0;       // the greatest share of what can be used; the choice of memories with the least
  Resource most = kLut;     // of what
  bool fits() const { return fullest <= 1; }
};

struct Point {
  Configuration hw;
  std::size_t parts = 0;  // in Swept::parts
  int clock_mhz = 0;
  std::int64_t cycles = 0;     // of the run, while the memory always answers
  std::int64_t on_memory = 0;  // with the memory's time
  std::int64_t speed = 0;      // thousand cell-steps a second
  Taken taken;
};

struct Swept {
  std::vector<PartList> parts;  // by lanes, sub-steps and width of a tile
  std::vector<Point> points;
  double seconds = 0;
};

Swept sweep(const Question& question, const Axes& axes, const std::function<void()>& poll);

// `relaxed`: of this resource there is any amount.
Taken taken_by(const PartList& parts, const Configuration& hw, const Device& device,
               std::optional<Resource> relaxed = {});
// The fewest of one resource with which it fits, if all others suffice.
std::optional<std::int64_t> least_of(Resource resource, const PartList& parts, const Configuration& hw,
                                     const Device& device);

// The closed form for a run.
struct RunTime {
  std::int64_t cycles = 0, on_memory = 0, steps = 0;
};
RunTime time_of(const PartList& parts, const Configuration& hw, int clock_mhz, const Question& question,
                std::int64_t steps);
std::int64_t speed_of(const Question& question, const RunTime& time, int clock_mhz);

}  // namespace voxmelt::hwmodel::explore
