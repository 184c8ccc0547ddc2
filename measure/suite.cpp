#include "measure/suite.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "kernel/run/simulation.h"
#include "measure/paper.h"
#include "measure/picture.h"
#include "measure/texts.h"

namespace voxmelt::measure {
namespace {

std::optional<cpu::InstructionSet> set_named(const std::string& name) {
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
    if (name == row.name) return row.set;
  return std::nullopt;
}

// Returns the bytes that the active cells take: so many must come through the caches at least.
std::size_t footprint(const Workload& workload, std::int64_t active) {
  const bool paper = workload.parameters.flow.law == rule::Law::paper;
  const double bytes = 2.0 * (1 + paper + workload.parameters.heat.enabled) + 3.0 / 8;
  return static_cast<std::size_t>(bytes * static_cast<double>(active));
}

// The paper counts excess as spreading.
TableRow table_row(std::string scene, std::string program, const state::Grid& grid, const Seconds& step,
                   double update) {
  const double gravity = step.phase[index_of(step::Phase::gravity)];
  return {std::move(scene), std::move(program),         grid, gravity * 1e3, (step.flow() - gravity) * 1e3,
          update * 1e3,     1 / (step.total() + update)};
}

}  // namespace

double seconds_of(Subject subject, const Seconds& step) {
  return subject == Subject::heat ? step.heat() : step.flow();
}

std::optional<double> ratio_to(const std::optional<Seconds>& baseline, const Seconds& ours, Subject subject) {
  if (!baseline) return std::nullopt;
  return seconds_of(subject, *baseline) / seconds_of(subject, ours);
}

std::vector<Scaling> scaling_of(const std::vector<Case>& cases) {
  std::vector<Scaling> result;
  for (const Case& several : cases)
    for (const Case& one : cases)
      if (one.workload == several.workload && one.workload.starts_with("dense:") &&
          one.subject == several.subject && one.implementation == several.implementation &&
          one.threads == 1 && several.threads > 1)
        result.push_back({one.workload, one.implementation, several.threads, one.seconds / several.seconds});
  return result;
}

void bound_scenes(std::vector<Case>& cases) {
  const auto full = [&](const Case& scene, Subject subject, const std::string& workload) {
    std::optional<FullVolume> found;
    for (const Case& one : cases)
      if (one.workload == workload && one.subject == subject && one.threads == 1 &&
          one.implementation == scene.implementation)
        found = FullVolume{one.step, static_cast<double>(one.cells)};
    return found;
  };
  for (Case& one : cases) {
    const std::optional<cpu::InstructionSet> set = set_named(one.implementation);
    if (!one.needed || !set) continue;
    const auto flow = full(one, Subject::flow,
                           fmt::format("dense:{}/law:paper/heat:{}", kFullSide, one.hot ? "on" : "off"));
    const auto heat =
        full(one, Subject::heat, fmt::format("dense:{}/solid/neighbours:{}", kFullSide, one.heat_neighbours));
    if (!flow) continue;
    const LeastSeconds least = least_seconds(*one.needed, lanes_of(*set), one.threads, *flow, heat);
    one.least_seconds = one.subject == Subject::heat ? least.heat : least.flow;
  }
}

Suite::Suite(Plan plan, Tell tell) : plan_(std::move(plan)), tell_(std::move(tell)) {
  findings_.machine_text = describe_machine();
  findings_.load_before = load_average();
  findings_.machine = Machine({.fewest = 5, .seconds = plan_.quick ? 0.04 : 0.2});
  if (!plan_.automaton) return;
  for (const int threads : plan_.threads) {
    for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
      if (row.supported()) findings_.machine.lane_rates(row.set, threads);
    if (findings_.machine_text.l2_bytes > 0)
      findings_.machine.bandwidth(findings_.machine_text.l2_bytes / 2 * threads, threads);
    findings_.machine.bandwidth(std::size_t{1} << 29, threads);
  }
}

std::optional<Roof> Suite::roof_of_case(const Case& one) {
  const std::optional<cpu::InstructionSet> set = set_named(one.implementation);
  if (!set || one.footprint == 0) return std::nullopt;
  return roof_of(one.work, findings_.machine.lane_rates(*set, one.threads),
                 findings_.machine.bandwidth(one.footprint, one.threads));
}

std::vector<Case> Suite::cases_of(const Workload& workload, const Result& result) {
  std::vector<Case> cases;
  for (const Subject subject : {Subject::flow, Subject::heat}) {
    const bool heat = subject == Subject::heat;
    if (!(heat ? workload.times_heat : workload.times_flow)) continue;
    for (const Timing& timing : result.timings) {
      Case one;
      one.subject = subject;
      one.law = workload.parameters.flow.law;
      one.workload = workload.name;
      one.implementation = timing.candidate.implementation->name;
      one.threads = timing.candidate.threads;
      one.name =
          fmt::format("{}/{}/{}/threads:{}", name_of(subject), one.implementation, one.workload, one.threads);
      one.judge = workload.judge;
      one.grid = workload.start.grid;
      one.cells = workload.start.grid.cells();
      one.hot = workload.parameters.heat.enabled;
      one.heat_neighbours = workload.parameters.heat.neighbours;
      one.active = active_cells(workload, heat);
      one.rounds = result.rounds;
      one.step = timing.step;
      one.seconds = seconds_of(subject, timing.step);
      one.median_seconds = heat ? timing.median.heat : timing.median.flow;
      one.work = work_of(subject, workload.parameters);
      one.bytes_per_cell = one.work.bytes;
      if (!workload.at_rest) one.footprint = footprint(workload, one.active);
      one.roof = roof_of_case(one);
      one.ratio_to_baseline = ratio_to(result.plain, timing.step, subject);
      one.ratio_to_native = ratio_to(result.native, timing.step, subject);
      cases.push_back(std::move(one));
    }
  }
  return cases;
}

void Suite::run(const Workload& workload, bool baseline) {
  std::vector<Candidate> candidates;
  for (const step::Implementation* implementation : plan_.implementations)
    for (const int threads : plan_.threads) {
      if (implementation->name == "reference" && threads != plan_.threads.front()) continue;
      candidates.push_back({implementation, threads});
    }
  findings_.machine.refresh_rates();
  const Result result = measure(workload, candidates, plan_.rounds, baseline);
  const std::vector<Case> cases = cases_of(workload, result);
  tell_(workload, result, cases);

  findings_.cases.insert(findings_.cases.end(), cases.begin(), cases.end());

  for (const auto& row : kPaperTable) {
    if (!workload.name.starts_with(fmt::format("scene:{}/", row.scene)) || !result.plain) continue;
    const state::Grid g = workload.start.grid;
    findings_.table_1.push_back(
        {row.as, "the paper, 2003", g, row.gravity, row.spreading, row.update, row.frames()});
    findings_.table_1.push_back(table_row(row.as, "its program, plainly written, here", g, *result.plain,
                                          baseline_update_seconds(workload, plan_.picture_rounds())));
  }
}

void Suite::count_needed(const Workload& workload) {
  if (workload.parameters.flow.law != rule::Law::paper) return;
  std::vector<int> lanes(cpu::kInstructionSets.size());
  std::ranges::transform(cpu::kInstructionSets, lanes.begin(),
                         [](const cpu::InstructionSetRow& row) { return lanes_of(row.set); });
  const std::vector<Needed> needed = needed_vectors(workload, lanes);
  for (Case& one : findings_.cases) {
    const std::optional<cpu::InstructionSet> set = set_named(one.implementation);
    if (one.workload == workload.name && set) one.needed = needed[static_cast<std::size_t>(*set)];
  }
}

void Suite::run_scene(const Workload& workload, const scene::Scene& scene) {
  const std::size_t rows = findings_.table_1.size();
  run(workload);
  count_needed(workload);
  if (findings_.table_1.size() == rows) return;  // not one of the paper's
  const std::string as = findings_.table_1.back().scene;
  for (const int threads : plan_.threads) {
    const Candidate candidate{plan_.implementations.back(), threads};
    const double update =
        update_seconds(workload, scene.look, scene.terrain, candidate, plan_.picture_rounds());
    for (const Case& one : findings_.cases) {
      if (one.workload != workload.name || one.subject != Subject::flow || one.threads != threads ||
          one.implementation != candidate.implementation->name)
        continue;
      findings_.table_1.push_back(
          table_row(as, fmt::format("voxmelt, {}, {}", one.implementation, threads_text(threads)), one.grid,
                    one.step, update));
    }
  }
}

void Suite::run_dense() {
  for (const bool heat : {false, true}) run(dense_paper(kFullSide, heat));
  if (!plan_.quick) run(dense_heat(kFullSide, 6));
  const int n = plan_.quick ? kFullSide : 128;
  if (!plan_.quick)
    for (const bool heat : {false, true}) run(dense_paper(n, heat));
  for (const bool heat : {false, true}) run(dense_viscous(n, heat));
  if (!plan_.quick) run(dense_paper(256, false));
  run(dense_heat(n, 6));
  if (!plan_.quick) run(dense_heat(n, 26));
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) run(asleep({n, n, n}, n / 2, law));

  // These are too large for the reference, and for the baseline's seven real fields. Another implementation
  // is judge.
  if (plan_.quick || findings_.machine_text.memory_bytes < std::size_t{8} << 30) return;
  run_large(dense_paper(512, false));
  run_large(asleep({1024, 256, 1024}, 16, rule::Law::paper));
}

void Suite::run_large(Workload large) {
  const auto& all = run::implementations().all();
  const std::vector<const step::Implementation*> chosen =
      std::exchange(plan_.implementations, {plan_.implementations.back()});
  for (const step::Implementation& other : all)
    if (other.supported && other.name != chosen.back()->name) large.judge = other.name;
  run(large, false);
  plan_.implementations = chosen;
}

const Drawing& Suite::run_drawing(const Workload& workload, const scene::Scene& scene) {
  findings_.drawings.push_back(measure_drawing(workload, scene, plan_.drawers, plan_.threads, plan_.rounds));
  return findings_.drawings.back();
}

const std::vector<FinerGrid>& Suite::run_finer_grids(const std::vector<scene::Scene>& scenes,
                                                     std::uint32_t step) {
  return findings_.finer_grids =
             measure_finer_grids(scenes, plan_.drawers, plan_.threads.back(), plan_.rounds, step);
}

const MeltFilm& Suite::run_film(const scene::Scene& scene) {
  findings_.films.push_back(measure_melt_film(scene, plan_.quick ? kFilmFrames / 30 : kFilmFrames,
                                              plan_.threads.back(), plan_.quick ? 1 : 3));
  return findings_.films.back();
}

DeviceBench& Suite::device_bench() {
  if (!device_)
    device_.emplace(*plan_.device, Candidate{plan_.implementations.back(), plan_.threads.back()},
                    plan_.rounds);
  return *device_;
}

const DeviceCase& Suite::run_on_device(const Workload& workload, const scene::Scene* scene) {
  findings_.device_cases.push_back(device_bench().run(workload, scene));
  findings_.device = device_bench().machine();
  return findings_.device_cases.back();
}

Findings Suite::take() {
  findings_.machine.refresh_all();
  for (Case& one : findings_.cases) one.roof = roof_of_case(one);
  bound_scenes(findings_.cases);
  findings_.scaling = scaling_of(findings_.cases);
  findings_.load_after = load_average();
  return std::move(findings_);
}

}  // namespace voxmelt::measure
