// The command `voxmelt bench` tells how fast the program is, how near to the machine's limits, and how many
// times as fast as the paper's program.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/beginning.h"
#include "app/bench_text.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/programs.h"
#include "app/version.h"
#include "app/visibility.h"
#include "kernel/engine/cpu/instruction_set.h"
#include "kernel/run/io/output_folder.h"
#include "kernel/run/opening/checkpoint_scene.h"
#include "measure/machine.h"
#include "measure/suite.h"
#include "measure/texts.h"
#include "report/bench/report.h"

namespace voxmelt::app {
namespace {

constexpr const char* kEvery = "all";  // value of --implementation

struct BenchOptions {
  Common common;
  std::vector<std::string> parts;  // empty: what is usual
  std::vector<std::string> scenes;
  std::optional<std::string> from;  // a step, or a checkpoint
  std::string out;
  bool quick = false;

  bool wants(const char* part) const { return std::find(parts.begin(), parts.end(), part) != parts.end(); }
  bool names_a_device() const {
    return common.implementation == "gpu" || common.implementation.starts_with("gpu:");
  }
};

// A device runs whole steps, so it has a part of its own.
const step::Implementation* device_of(const BenchOptions& options) {
  if (!options.wants("device")) return nullptr;
  Common common = options.common;
  if (!options.names_a_device()) common.implementation = "gpu";
  return &find_implementation(common);
}

void note(const Common& common, const std::string& text) {
  if (!common.quiet) say(text);
}

measure::Plan plan_of(const BenchOptions& options) {
  measure::Plan plan;
  plan.quick = options.quick;
  if (options.quick) plan.rounds = {.fewest = 3, .seconds = 1};
  plan.device = device_of(options);
  const bool alone = plan.device != nullptr && options.parts.size() == 1;  // processors are only beside it
  const bool every = options.common.implementation == kEvery || (alone && options.names_a_device());
  if (every) {
    for (const auto& one : run::implementations().all())
      if (one.supported && one.name != "reference") plan.implementations.push_back(&one);
    if (plan.implementations.empty()) plan.implementations.push_back(&run::implementations().all().front());
  } else {
    plan.implementations.push_back(&find_phased_implementation(options.common));
  }
  const int all = thread_count(options.common);
  if (options.common.threads > 0)
    plan.threads = {all};
  else if (all > 1)
    plan.threads = {1, all};
  plan.automaton = options.wants("automaton");
  for (const cpu::InstructionSetRow& row : cpu::kInstructionSets)
    if (row.supported() && (every || options.common.implementation == row.name))
      plan.drawers.push_back(measure::drawer_of(row.set));
  // The automaton's reference draws no pictures.
  if (plan.drawers.empty()) plan.drawers.push_back(measure::drawer_of(cpu::widest()));
  return plan;
}

std::vector<scene::Scene> load_scenes(const Common& common, const std::vector<std::string>& names) {
  std::vector<scene::Scene> scenes;
  for (const std::string& name : names) {
    Common one = common;
    one.scene = name;
    scenes.push_back(load_scene(one));
    refuse_changes(scenes.back(), "bench");
  }
  return scenes;
}

// Loads the bunny, and its finer grids beside it.
std::vector<scene::Scene> finer_scenes(const BenchOptions& options) {
  std::vector<scene::Scene> scenes = load_scenes(options.common, {"bunny"});
  const std::filesystem::path large = scenes.front().file.parent_path() / "large";
  std::vector<std::string> finer{(large / "bunny_256.toml").string()};
  if (!options.quick) finer.push_back((large / "bunny_512.toml").string());
  for (scene::Scene& scene : load_scenes(options.common, finer)) scenes.push_back(std::move(scene));
  return scenes;
}

std::vector<std::string> film_scenes(bool quick) {
  return quick ? std::vector<std::string>{"bunny_small"}
               : std::vector<std::string>{"cello", "goblet", "lava"};
}

// Writes the report. It also writes tables and plot into `out`, unless it is null.
void write_findings(const BenchOptions& options, const measure::Findings& findings, io::OutputFolder* out) {
  const std::string report = measure::bench_json(findings, version_text());
  write_report(options.common, report);
  if (out == nullptr) return;
  io::write_file(out->partial() / "bench.json", report);
  if (options.wants("automaton") || options.wants("device"))
    io::write_file(out->partial() / "bench.csv", measure::bench_csv(findings));
  io::write_file(out->partial() / "performance_tables.md",
                 measure::short_tables(findings) + measure::full_tables(findings) +
                     measure::picture_tables(findings) + measure::device_tables(findings));
  if (options.wants("automaton"))
    io::write_file(out->partial() / "roofline.svg", measure::roofline_svg(findings));
  out->commit();
  if (!options.common.quiet) print("tables, plot and report  {}/\n", seen_from_here(out->place()));
}

// `own`: how many threads of ours are in the load.
void warn_of_load(double load, int own) {
  const std::string busy = measure::busy_text(load, own, measure::describe_machine().threads);
  if (!busy.empty()) say("warning: " + busy);
}

void print_on_device(measure::Suite& suite, const measure::Workload& workload,
                     const scene::Scene* scene = nullptr) {
  const measure::DeviceCase& one = suite.run_on_device(workload, scene);
  print_device_case(suite.device(), one);
}

int run_bench(BenchOptions options) {
  std::optional<std::uint32_t> from;
  if (options.from && names_a_file(*options.from)) {
    if (!run::is_checkpoint(*options.from)) steps_of(*options.from);  // throws, and says what it is not
    if (!options.scenes.empty())
      throw UsageError(fmt::format("error: --from {}: a checkpoint is a scene of its own, without --scenes",
                                   *options.from));
    options.scenes = {*options.from};
  } else if (options.from) {
    from = steps_of(*options.from);
  }
  if (options.parts.empty() && options.names_a_device()) options.parts = {"device"};
  if (options.parts.empty()) options.parts = {"automaton", "picture"};
  const measure::Plan plan = plan_of(options);
  check_report_place(options.common, options.out);
  end_soon_at_interrupts();
  std::optional<io::OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);

  // All scenes are read before anything is timed: bad input ends at once.
  const auto scenes_of = [&](bool wanted, const std::vector<std::string>& usual) {
    return wanted ? load_scenes(options.common, options.scenes.empty() ? usual : options.scenes)
                  : std::vector<scene::Scene>{};
  };
  const bool automaton = options.wants("automaton"), picture = options.wants("picture");
  const bool device = plan.device != nullptr;
  const auto scenes = scenes_of(automaton || picture || device, measure::usual_scenes(options.quick));
  const auto finer = options.wants("grids") && options.scenes.empty() ? finer_scenes(options)
                                                                      : scenes_of(options.wants("grids"), {});
  const auto films = scenes_of(options.wants("film"), film_scenes(options.quick));

  warn_of_load(measure::load_average(), 0);
  if (automaton) {
    note(options.common, "measuring the machine");
    print_case_heading();
  }
  measure::Suite suite(plan, print_workload);
  for (const scene::Scene& scene : scenes) {
    const std::uint32_t middle = scene.mid_run ? scene.mid_run->steps_done : measure::middle_of(scene.name);
    const std::uint32_t step = from.value_or(middle > 0 ? middle : scene.steps / 2);
    check_steps(scene, step);
    note(options.common, fmt::format("melting {} to step {}", scene.name, step));
    const int threads = thread_count(options.common);
    auto provider = make_provider(choose_visibility(options.common.visibility), threads);
    const measure::Workload workload = measure::scene_at(scene, step, threads, std::move(provider));
    if (automaton) suite.run_scene(workload, scene);
    if (picture) print_drawing(suite.run_drawing(workload, scene));
    if (device) print_on_device(suite, workload, &scene);
  }
  if (automaton && options.scenes.empty()) suite.run_dense();
  if (device && options.scenes.empty())
    for (const measure::Workload& workload : suite.dense_on_device()) print_on_device(suite, workload);
  if (!finer.empty()) print_finer_grids(suite.run_finer_grids(finer, from.value_or(0)));
  for (const scene::Scene& scene : films) print_film(suite.run_film(scene));

  const measure::Findings findings = suite.take();
  warn_of_load(findings.load_after, plan.threads.back());
  write_findings(options, findings, out ? &*out : nullptr);
  return kDone;
}

}  // namespace

void add_bench(CommandLine& program) {
  auto options = std::make_shared<BenchOptions>();
  const Command command = program.add("bench", std::string(description_of("bench")));
  command
      .option("--parts", options->parts,
              "what to measure, with commas between: automaton, picture, grids (pictures of finer and\n"
              "finer grids), film (a whole melt), device (whole steps on a device, its kernels, what goes to "
              "and fro)\n"
              "(default: automaton,picture, or device if --implementation names one)")
      .separated_by(',')
      .one_of({"automaton", "picture", "grids", "film", "device"});
  command.flag("--quick", options->quick, "small cases only: about half a minute");
  command
      .option("--scenes", options->scenes,
              "these scenes only, with commas between them (default: the showcase scenes, and dense volumes)")
      .separated_by(',');
  command.option("--from", options->from,
                 "step of the scenes to time (default: the middle of their melt), or a checkpoint");
  command.option("--out", options->out,
                 "folder for bench.json, bench.csv, performance_tables.md and roofline.svg");
  options->common.implementation = kEvery;
  add_common(command, options->common);
  command.find("--implementation")
      .described_as("who computes: all but the reference, auto, or a name of `voxmelt list implementations`");
  add_visibility(command, options->common);
  command.footer(
      "Without --implementation it times every instruction set of this processor, without --threads one\n"
      "thread and all. Every result is compared with the reference before its time counts. Each phase of\n"
      "each step is timed in up to 40 rounds and counts with its shortest time. Ratios are to the paper's\n"
      "program (plainly written, and compiled for this processor), timed in the same rounds. The roof is\n"
      "what the definition needs, at the best rates that this run measured on the machine.\n"
      "Pictures are timed part by part. On one thread their times are processor time.");
  command.runs([options] { return run_bench(*options); });
}

}  // namespace voxmelt::app
