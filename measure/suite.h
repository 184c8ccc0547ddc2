// The suite runs all that `voxmelt bench` measures, and keeps the results.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "measure/device_steps.h"
#include "measure/drawing.h"
#include "measure/finer_grids.h"
#include "measure/machine.h"
#include "measure/measure.h"
#include "measure/melt_film.h"
#include "measure/needed.h"
#include "measure/roof.h"

namespace voxmelt::measure {

// A case is one line of the tables: a workload, a subject, an implementation, a number of threads.
struct Case {
  std::string name;  // "flow/avx512/scene:cello/step:1050/threads:2"
  Subject subject = Subject::flow;
  rule::Law law = rule::Law::paper;
  std::string workload, implementation;
  int threads = 1;
  std::string judge;
  state::Grid grid;
  std::int64_t cells = 0, active = 0;  // all cells of the grid, and those that concern the subject
  bool hot = false;                    // the state has heat
  int heat_neighbours = 0;
  int rounds = 0;             // rounds that the minima were taken over
  Seconds step;               // with all phases
  double seconds = 0;         // the subject's time in that step
  double median_seconds = 0;  // median of the rounds, each with a mean step
  double bytes_per_cell = 0;  // needed by the definition
  Work work;
  std::size_t footprint = 0;  // bytes of the active cells' state
  std::optional<Roof> roof;   // none at rest, and for the reference
  std::optional<double> ratio_to_baseline, ratio_to_native;
  std::optional<Needed> needed;         // for a scene under the paper's law
  std::optional<double> least_seconds;  // time for the needed vectors at the speed of a full volume

  double cells_per_second() const { return static_cast<double>(cells) / seconds; }
  double active_per_second() const { return static_cast<double>(active) / seconds; }
  std::optional<double> percent_of_roof() const {
    return roof ? std::optional(100 * active_per_second() / roof->cells()) : std::nullopt;
  }
  std::optional<double> least_ratio_to_baseline() const {
    return least_seconds && ratio_to_baseline ? std::optional(*ratio_to_baseline * seconds / *least_seconds)
                                              : std::nullopt;
  }
};

// The full volume of kFullSide cells a side bounds the speed of scenes. It fits a second-level cache.
inline constexpr int kFullSide = 64;
// Sets least_seconds if the cases hold what it needs: full volumes on one thread, by the same kernels.
void bound_scenes(std::vector<Case>& cases);

// Holds a row of the paper's Table 1, or voxmelt's beside it, in milliseconds.
struct TableRow {
  std::string scene, program;
  state::Grid grid;
  double gravity = 0, spreading = 0, update = 0;
  double frames_per_second = 0;  // a frame is a step with all its phases, and the update
};

// Tells how many times faster several threads are than one. A measurement may exceed any bound of either
// number: see docs/decisions/performance-minima.md.
struct Scaling {
  std::string workload, implementation;
  int threads = 2;
  double speedup = 1;
  double efficiency() const { return speedup / threads; }
};
// Compares each dense case with more than one thread with the same case with one.
std::vector<Scaling> scaling_of(const std::vector<Case>& cases);

double seconds_of(Subject subject, const Seconds& step);  // flow or heat
// Returns how many times as long the baseline takes, or nothing if it did not run.
std::optional<double> ratio_to(const std::optional<Seconds>& baseline, const Seconds& ours, Subject subject);

struct Findings {
  MachineText machine_text;
  double load_before = 0, load_after = 0;  // load averages, before and after everything was measured
  Machine machine;
  std::vector<Case> cases;
  std::vector<TableRow> table_1;
  std::vector<Scaling> scaling;
  // These are the findings about the picture.
  std::vector<Drawing> drawings;
  std::vector<FinerGrid> finer_grids;
  std::vector<MeltFilm> films;
  // These are the findings about a device.
  std::optional<DeviceMachine> device;
  std::vector<DeviceCase> device_cases;
};

struct Plan {
  bool quick = false;
  std::vector<const step::Implementation*> implementations;
  std::vector<int> threads{1};                   // ascending
  std::vector<Drawer> drawers;                   // the drawers of pictures
  const step::Implementation* device = nullptr;  // that runs whole steps, or none
  bool automaton = true;  // false: the machine is not measured, because nothing is held against it
  Rounds rounds;
  Rounds picture_rounds() const { return {rounds.fewest, rounds.seconds / 5}; }
};

class Suite {
 public:
  // The function `tell` is called with each workload's cases as soon as they are known.
  using Tell = std::function<void(const Workload&, const Result&, const std::vector<Case>&)>;
  Suite(Plan plan, Tell tell);

  void run(const Workload& workload, bool baseline = true);
  // Also fills a row of Table 1 if the paper has the scene.
  void run_scene(const Workload& workload, const scene::Scene& scene);
  void run_dense();  // everything that is no scene

  // Each of these measures a part of the picture, and keeps and returns its findings.
  const Drawing& run_drawing(const Workload& workload, const scene::Scene& scene);
  const std::vector<FinerGrid>& run_finer_grids(const std::vector<scene::Scene>& scenes, std::uint32_t step);
  const MeltFilm& run_film(const scene::Scene& scene);

  // Each of these is about plan.device, beside the last implementation with the most threads.
  const DeviceCase& run_on_device(const Workload& workload, const scene::Scene* scene = nullptr);
  std::vector<Workload> dense_on_device() { return device_bench().dense(plan_.quick); }
  const DeviceMachine& device() { return device_bench().machine(); }

  // Measures the machine once more. Tables and report use the better of its rates, for all cases alike.
  Findings take();

 private:
  DeviceBench& device_bench();
  void run_large(Workload large);  // one implementation, judged by another
  std::vector<Case> cases_of(const Workload& workload, const Result& result);
  std::optional<Roof> roof_of_case(const Case& one);
  void count_needed(const Workload& workload);

  Plan plan_;
  Tell tell_;
  Findings findings_;
  std::optional<DeviceBench> device_;
};

}  // namespace voxmelt::measure
