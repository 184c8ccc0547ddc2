// A sweep tries all configurations of some axes by the closed forms. They tell how fast each one is, what it
// takes of a device, and whether it fits.
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
#include "hwmodel/explore/run_energy.h"
#include "hwmodel/memory/parameters.h"

namespace voxmelt::hwmodel::explore {

// Holds the scene, the device and the memory that are asked about.
struct Question {
  rule::Parameters parameters;
  state::Grid grid;
  std::uint32_t first_step = 0;
  std::int64_t steps = 32;
  Device device;
  std::optional<memory::Parameters> memory;  // none if it always answers
  const Irradiance* irradiance = nullptr;    // at the first step; null if dark
  bool falls = false;                        // does a piece fall in the first step?
  const state::Volume* volume = nullptr;     // before the first step; if null, hw.coded is not tried
  int substeps = 1;                          // of the first step, under the viscous law
};

// Lists the values that are tried. A further axis is a list here and a row below, with its values in axes.cpp
// and a loop in `sweep`. `tiles` holds numbers of tiles: hw.tile is the narrowest that gives each.
struct Axes {
  std::vector<int> lanes, cascade, substeps, fifo_depth, overlap, coded, tiles{1}, clock_mhz;
  std::optional<int> tile{};  // this hw.tile alone, whatever `tiles` says
};
// Describes an axis that is a key of [hw].
struct Axis {
  std::string_view key;
  std::vector<int> Axes::*values;
};
inline constexpr std::array kAxes{Axis{"lanes", &Axes::lanes},        Axis{"cascade", &Axes::cascade},
                                  Axis{"substeps", &Axes::substeps},  Axis{"fifo_depth", &Axes::fifo_depth},
                                  Axis{"overlap", &Axes::overlap},    Axis{"coded", &Axes::coded},
                                  Axis{"clock_mhz", &Axes::clock_mhz}};
Axes usual_axes(const Question& question);
// Returns numbers of lanes for a grid that is so many cells wide. If several make as many blocks, it is the
// least of them: the others would leave lanes idle.
std::vector<int> lanes_worth_trying(int across);
// Returns the values of hw.tile for the lanes and steps of `hw`.
std::vector<int> tiles_of(const Axes& axes, const Question& question, const Configuration& hw);
// Keeps a single value of each axis that `sets` names, such as "hw.lanes=8". Throws scene::InputError.
void keep_only(Axes& axes, const std::vector<std::string>& sets);

// Counts what a configuration takes of a device.
struct Taken {
  Amounts amounts{};
  std::int64_t lutram = 0;  // LUTs that are memory
  double fullest = 0;       // greatest share of what can be used, by the choice of memories with the least
  Resource most = kLut;     // the resource with this share
  bool fits() const { return fullest <= 1; }
};

struct Point {
  Configuration hw;
  std::size_t parts = 0;  // index into Swept::parts
  int clock_mhz = 0;
  std::int64_t cycles = 0;     // the whole run, while the memory always answers
  std::int64_t on_memory = 0;  // with the memory's time
  std::int64_t speed = 0;      // thousand cell-steps a second
  Taken taken;
  std::int64_t energy = 0;         // femtojoules of a cell-step: operations, and the memory
  std::int64_t memory_energy = 0;  // of the memory alone
};

struct Swept {
  std::vector<PartList> parts;  // one for each choice of lanes, sub-steps and tile width
  std::vector<Point> points;
  double seconds = 0;
};

Swept sweep(const Question& question, const Axes& axes, const std::function<void()>& poll);

// If `relaxed` is given, there is any amount of this resource.
Taken taken_by(const PartList& parts, const Configuration& hw, const Device& device,
               std::optional<Resource> relaxed = {});
// Tells that a configuration cannot fit, whatever memories it chooses. This is much quicker than taken_by.
bool too_large(const PartList& parts, const Configuration& hw, const Device& device);
// Returns the fewest units of one resource with which the configuration fits, if all others suffice.
std::optional<std::int64_t> least_of(Resource resource, const PartList& parts, const Configuration& hw,
                                     const Device& device);

// Holds the results of the closed form for a run.
struct RunTime {
  std::int64_t cycles = 0, on_memory = 0, steps = 0;
  RunEnergy energy{};
};
RunTime time_of(const PartList& parts, const Configuration& hw, int clock_mhz, const Question& question,
                std::int64_t steps);
std::int64_t speed_of(const Question& question, const RunTime& time, int clock_mhz);
// Returns femtojoules of a cell-step.
std::int64_t per_cell_step(const Question& question, std::int64_t steps, double picojoules);

}  // namespace voxmelt::hwmodel::explore
