#include "bench/measure/suite.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/measure/picture.h"
#include "kernel/run/simulation.h"

namespace voxmelt::measure {
namespace {

constexpr struct {
  const char* scene;
  const char* as;
  double gravity, spreading, update, frames;
} kPaper[] = {{"cello", "Cello", 3.2, 15.6, 65.8, 1000 / 84.6},
              {"goblet", "Chocolate", 3.2, 18.4, 83.8, 1000 / 105.4},
              {"lava", "Lava", 3.2, 21.6, 90.2, 1000 / 115.0}};

std::optional<cpu::InstructionSet> set_named(const std::string& name) {
  for (const auto& [set, its_name] : cpu::kInstructionSets)
    if (name == its_name) return set;
  return std::nullopt;
}

// Bytes that the active cells take: what must come through the caches at least.
std::size_t footprint(const Workload& workload, std::int64_t active) {
  const bool paper = workload.parameters.flow.law == rule::Law::paper;
  const double bytes = 2.0 * (1 + paper + workload.parameters.heat.enabled) + 3.0 / 8;
  return static_cast<std::size_t>(bytes * static_cast<double>(active));
}

}  // namespace

std::optional<double> Case::percent_of_roof_beside() const {
  if (!roof || rounds.empty()) return std::nullopt;
  std::vector<double> percents;
  for (const Round& round : rounds) {
    const double rate = static_cast<double>(active) / (subject == Subject::heat ? round.heat : round.flow);
    const Roof beside{roof_of(work, round.rates, {}).operations, roof->bytes};
    percents.push_back(100 * rate / beside.cells());
  }
  return median(percents);
}

Suite::Suite(Plan plan, Tell tell) : plan_(std::move(plan)), tell_(std::move(tell)) {
  findings_.machine_text = describe_machine();
  findings_.machine = Machine(plan_.quick ? 0.004 : 0.02);
  for (const int threads : plan_.threads) {
    for (const auto& [set, name] : cpu::kInstructionSets)
      if (cpu::supported(set)) findings_.machine.lane_rates(set, threads);
    if (findings_.machine_text.l2_bytes > 0)
      findings_.machine.bandwidth(findings_.machine_text.l2_bytes / 2 * static_cast<std::size_t>(threads),
                                  threads);
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
      one.cells = static_cast<std::int64_t>(workload.start.grid.cells());
      one.active = active_cells(workload, heat);
      one.phases = timing.median;
      one.seconds = heat ? timing.heat : timing.flow;
      one.work = work_of(subject, workload.parameters);
      one.bytes_per_cell = one.work.bytes;
      if (!workload.at_rest) one.footprint = footprint(workload, one.active);
      one.roof = roof_of_case(one);
      one.rounds = timing.rounds;
      one.ratio_to_baseline = heat ? timing.heat_ratio : timing.flow_ratio;
      one.ratio_to_native = heat ? timing.heat_native_ratio : timing.flow_native_ratio;
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
  const auto rates_now = [this](const Candidate& candidate) {
    const std::optional<cpu::InstructionSet> set = set_named(candidate.implementation->name);
    return set ? findings_.machine.lane_rates_now(*set, candidate.threads) : LaneRates{};
  };
  const Result result = measure(workload, candidates, plan_.rounds, baseline, rates_now);
  const std::vector<Case> cases = cases_of(workload, result);
  tell_(workload, result, cases);

  findings_.cases.insert(findings_.cases.end(), cases.begin(), cases.end());

  for (const auto& row : kPaper) {
    if (!workload.name.starts_with(fmt::format("scene:{}/", row.scene)) || !result.plain_gravity) continue;
    const state::Grid g = workload.start.grid;
    findings_.table_1.push_back(
        {row.as, "the paper, 2003", g, row.gravity, row.spreading, row.update, row.frames});
    const double update = baseline_update_seconds(workload, 3);
    const double step = *result.plain_flow + result.plain_heat.value_or(0);
    findings_.table_1.push_back({row.as, "its program, plainly written, here", g, *result.plain_gravity * 1e3,
                                 *result.plain_spread * 1e3, update * 1e3, 1 / (step + update)});
  }
}

void Suite::run_scene(const Workload& workload, const scene::Scene& scene) {
  const std::size_t rows = findings_.table_1.size();
  run(workload);
  if (findings_.table_1.size() == rows) return;  // not one of the paper's
  const std::string as = findings_.table_1.back().scene;
  for (const int threads : plan_.threads) {
    const Candidate candidate{plan_.implementations.back(), threads};
    const double update = update_seconds(workload, scene.look, scene.terrain, candidate, plan_.quick ? 1 : 3);
    for (const Case& one : findings_.cases) {
      if (one.workload != workload.name || one.subject != Subject::flow || one.threads != threads ||
          one.implementation != candidate.implementation->name)
        continue;
      const auto ms = [&](step::Phase phase) {
        return one.phases.phase[static_cast<std::size_t>(phase)] * 1e3;
      };
      findings_.table_1.push_back(
          {as, fmt::format("voxmelt, {}, {} thread{}", one.implementation, threads, threads == 1 ? "" : "s"),
           one.grid, ms(step::Phase::gravity), ms(step::Phase::spread) + ms(step::Phase::excess),
           update * 1e3, 1 / (one.phases.total() + update)});
    }
  }
}

void Suite::run_dense() {
  const int n = plan_.quick ? 64 : 128;
  for (const bool heat : {false, true}) run(dense_paper(n, heat));
  for (const bool heat : {false, true}) run(dense_viscous(n, heat));
  if (!plan_.quick) run(dense_paper(256, false));
  run(dense_heat(n, 6));
  if (!plan_.quick) run(dense_heat(n, 26));
  for (const rule::Law law : {rule::Law::paper, rule::Law::viscous}) run(asleep({n, n, n}, n / 2, law));

  // Too large for the reference, and for the baseline's seven real fields: another implementation is judge.
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

// Each implementation with all threads against the same with one, where the whole grid works.
std::vector<Scaling> Suite::scaling() const {
  std::vector<Scaling> result;
  for (const Case& all : findings_.cases)
    for (const Case& one : findings_.cases)
      if (one.workload == all.workload && one.workload.starts_with("dense:") && one.subject == all.subject &&
          one.implementation == all.implementation && one.threads == 1 && all.threads > 1 && one.roof &&
          all.roof)
        result.push_back({one.workload, one.implementation, all.threads, one.seconds / all.seconds,
                          std::min(static_cast<double>(all.threads), all.roof->cells() / one.roof->cells())});
  return result;
}

Findings Suite::take() {
  findings_.machine.refresh_all();
  for (Case& one : findings_.cases) one.roof = roof_of_case(one);
  findings_.scaling = scaling();
  return std::move(findings_);
}

}  // namespace voxmelt::measure
