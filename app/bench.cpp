// voxmelt bench: how fast it is, how near to the machine's limits, and how many times as fast as the
// paper's program.
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/options.h"
#include "app/version.h"
#include "app/visibility.h"
#include "bench/measure/report.h"
#include "bench/measure/suite.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

using measure::Case;
using measure::Subject;

struct BenchOptions {
  Common common;
  std::vector<std::string> scenes;
  std::optional<std::uint32_t> from;
  std::string out;
  bool quick = false;
};

void note(const Common& common, const std::string& text) {
  if (!common.quiet) std::cerr << text << '\n';
}

void print_case(const Case& one) {
  const auto phase = [&](step::Phase p) {
    return measure::milliseconds(one.step.phase[static_cast<std::size_t>(p)]);
  };
  using enum step::Phase;
  const std::string phases = one.subject == Subject::flow
                                 ? fmt::format("{} + {} + {}", phase(gravity), phase(spread), phase(excess))
                                 : fmt::format("{} + {}", phase(heat), phase(melt));
  fmt::print("  {:<5} {:<9} {:>7}  {:>8}  {:<22} {:>8.0f} {:>8.0f} {:>8} {:>6} {:>6} {:>8} {:>8} {:>6}\n",
             measure::name_of(one.subject), one.implementation, one.threads,
             measure::milliseconds(one.seconds), phases, one.cells_per_second() / 1e6,
             one.active_per_second() / 1e6, measure::three_digits(1e9 / one.active_per_second()),
             one.bytes_per_cell, measure::or_dash(one.percent_of_roof()),
             measure::or_dash(one.ratio_to_baseline), measure::or_dash(one.ratio_to_native), one.rounds);
}

void print_workload(const measure::Workload& workload, const measure::Result& result,
                    const std::vector<Case>& cases) {
  const state::Grid g = workload.start.grid;
  fmt::print("{}  {} x {} x {}, {:.1f} % liquid", workload.name, g.x, g.y, g.z,
             100 * static_cast<double>(workload.start.liquid.count()) / static_cast<double>(g.cells()));
  const auto print_baseline = [&](Subject subject) {
    const auto ms = [&](const measure::Seconds& step) {
      return measure::milliseconds(measure::seconds_of(subject, step));
    };
    if (result.plain) fmt::print("; {} of the baseline {} ms", measure::name_of(subject), ms(*result.plain));
    if (result.native) fmt::print(", native {} ms", ms(*result.native));
  };
  if (workload.times_flow) print_baseline(Subject::flow);
  if (workload.times_heat) print_baseline(Subject::heat);
  fmt::print("; checked against {}\n", workload.judge);
  for (const Case& one : cases) print_case(one);
  std::fflush(stdout);
  stop_if_interrupted();
}

measure::Plan plan_of(const BenchOptions& options) {
  measure::Plan plan;
  plan.quick = options.quick;
  if (options.quick) plan.rounds = {.fewest = 3, .seconds = 1};
  if (options.common.implementation == "auto") {
    for (const auto& one : run::implementations().all())
      if (one.supported && one.name != "reference") plan.implementations.push_back(&one);
    if (plan.implementations.empty()) plan.implementations.push_back(&run::implementations().all().front());
  } else {
    plan.implementations.push_back(&find_implementation(options.common));
  }
  const int all = thread_count(options.common);
  if (options.common.threads > 0)
    plan.threads = {all};
  else if (all > 1)
    plan.threads = {1, all};
  return plan;
}

int run_bench(const BenchOptions& options) {
  const measure::Plan plan = plan_of(options);
  check_report_place(options.common, options.out);
  std::optional<io::OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);

  // All scenes are read before anything is timed: bad input ends at once.
  std::vector<scene::Scene> scenes;
  for (const std::string& name :
       options.scenes.empty() ? measure::usual_scenes(options.quick) : options.scenes) {
    Common common = options.common;
    common.scene = name;
    scenes.push_back(load_scene(common));
  }
  catch_interrupts();

  note(options.common, "measuring the machine");
  fmt::print("{:<25}{:>8}  {:<22} {:>8} {:>8} {:>8} {:>6} {:>6} {:>8} {:>8}\n", "", "ms per",
             "gravity+spread+excess", "Mcells/s", "Mcells/s", "ns per", "bytes", "% of", "times", "times");
  fmt::print("  {:<5} {:<9} {:>7}  {:>8}  {:<22} {:>8} {:>8} {:>8} {:>6} {:>6} {:>8} {:>8} {:>6}\n", "", "by",
             "threads", "step", "or heat+melt", "grid", "active", "active", "/cell", "roof", "baseline",
             "native", "rounds");
  measure::Suite suite(plan, print_workload);
  for (const scene::Scene& scene : scenes) {
    const std::uint32_t middle = measure::middle_of(scene.name);
    const std::uint32_t step = options.from.value_or(middle > 0 ? middle : scene.steps / 2);
    note(options.common, fmt::format("melting {} to step {}", scene.name, step));
    const int threads = thread_count(options.common);
    auto provider = make_provider(
        choose_visibility(options.common.visibility, scene.parameters.heat, scene.initial.grid), threads);
    suite.run_scene(measure::scene_at(scene, step, threads, std::move(provider)), scene);
  }
  if (options.scenes.empty()) suite.run_dense();

  const measure::Findings findings = suite.take();
  const std::string report = measure::bench_json(findings, version_text());
  write_report(options.common, report);
  if (out) {
    io::write_file(out->partial() / "bench.json", report);
    io::write_file(out->partial() / "performance_tables.md",
                   measure::short_tables(findings) + measure::full_tables(findings));
    io::write_file(out->partial() / "roofline.svg", measure::roofline_svg(findings));
    out->commit();
    if (!options.common.quiet)
      fmt::print("tables, plot and report  {}/\n", std::filesystem::proximate(out->place()).string());
  }
  return kDone;
}

}  // namespace

void add_bench(CLI::App& program, Chosen& chosen) {
  auto options = std::make_shared<BenchOptions>();
  CLI::App* command = program.add_subcommand(
      "bench", "Throughput, beside what this machine could do at most and the paper's program");
  command->add_flag("--quick", options->quick, "small cases only: less than a minute");
  command
      ->add_option(
          "--scenes", options->scenes,
          "these scenes only, with commas between them (default: the showcase scenes, and dense volumes)")
      ->delimiter(',');
  command->add_option("--from", options->from,
                      "step of the scenes to time (default: the middle of their melt)");
  command->add_option("--out", options->out, "folder for bench.json, performance_tables.md and roofline.svg");
  add_common(*command, options->common);
  add_visibility(*command, options->common);
  command->footer(
      "Without --implementation it times every instruction set of this processor, without --threads one\n"
      "thread and all. Every result is compared with the reference before its time counts. Each phase of\n"
      "each step is timed in up to 40 rounds and counts with its shortest time. Ratios are to the paper's\n"
      "program (plainly written, and compiled for this processor), timed in the same rounds. The roof is\n"
      "what the definition needs, at the best rates that this run measured on the machine.");
  command->callback([options, &chosen] { chosen = [options] { return run_bench(*options); }; });
}

}  // namespace voxmelt::app
