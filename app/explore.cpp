// The command `voxmelt explore` finds the best hardware for a scene, on a device and a memory.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/programs.h"
#include "app/run_ahead.h"
#include "app/visibility.h"
#include "hwmodel/explore/explore_report.h"
#include "hwmodel/memory/sheet.h"
#include "hwmodel/pipeline/check/falling.h"
#include "hwmodel/pipeline/model/tiling.h"
#include "hwmodel/pipeline/streams/memory_streams.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace explore = hwmodel::explore;

struct ExploreCommand {
  Common common;
  std::string device, memory = "ddr4-2400", out;
  std::uint32_t steps = 32, from = 0, check_steps = 0;
  std::size_t points = 8;
  std::vector<std::string> device_sets, hw_sets;
};

// Splits the values of --set, which reaches the device, the axes of the sweep, and the scene.
void split_sets(ExploreCommand& command) {
  std::vector<std::string> scene;
  for (std::string& set : command.common.sets) {
    const bool of_device = set.starts_with("device.") || set.starts_with("family.");
    auto& one = of_device ? command.device_sets : set.starts_with("hw.") ? command.hw_sets : scene;
    one.push_back(std::move(set));
  }
  command.common.sets = std::move(scene);
}

std::optional<hwmodel::memory::Parameters> find_memory(const std::string& name) {
  if (name == "none") return {};
  std::string known = "none";
  bool there = hwmodel::is_memory_file(name);
  for (const hwmodel::MemoryFile& file : hwmodel::memory_files()) {
    there = there || file.name == name;
    known += ", " + file.name;
  }
  if (!there)
    throw UsageError(fmt::format(
        "error: --memory {}: no such memory; there are {}, or a file that ends in .toml, .json or .yaml",
        name, known));
  return hwmodel::load_memory(name, "--memory " + name);
}

// Chooses the best design, and others of the front at equal distances, the slowest among them.
std::vector<std::size_t> chosen_points(const explore::Answer& answer, std::size_t wanted) {
  std::vector<std::size_t> chosen;
  const std::size_t n = answer.front.size(), count = std::min(wanted, n);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(answer.front[count == 1 ? 0 : i * (n - 1) / (count - 1)]);
  return chosen;
}

// Every design lays out the same state, with its irradiance where that is brightest.
void require_stages_and_room(const explore::Question& question, const std::string& memory) {
  const std::string missing = hwmodel::unmodelled_rule(question.parameters);
  if (!missing.empty()) throw UsageError(fmt::format("error: {}", missing));
  if (!question.memory) return;
  const hwmodel::Design design = hwmodel::design_of(question.parameters, question.grid, {});
  const std::int64_t needed = hwmodel::stream_bytes(design, false), there = question.memory->bytes();
  if (needed > there)
    throw UsageError(
        fmt::format("error: --memory {}: has {} bytes; the pipeline's state and irradiance take up to {}",
                    memory, there, needed));
}

// Says every ten seconds that the sweep goes on.
class SweepProgress {
 public:
  explicit SweepProgress(bool quiet) : quiet_(quiet) {}
  void operator()() {
    stop_if_interrupted();
    const std::chrono::seconds now = since();
    if (quiet_ || now < said_ + std::chrono::seconds(10)) return;
    said_ = now;
    print_error("weighing designs, {} s\n", now.count());
  }

 private:
  std::chrono::seconds since() const {
    return std::chrono::duration_cast<std::chrono::seconds>(std::chrono::steady_clock::now() - begin_);
  }
  bool quiet_;
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::chrono::seconds said_{0};
};

// Tells what the feeds read in the first step, which begins with `start`.
void ask_of_first_step(explore::Question& question, const state::Volume& start, run::Simulation& ahead) {
  question.volume = &start;
  question.falls = hwmodel::cells_that_fall(question.parameters, question.first_step, start).has_value();
  ahead.begin_step();  // computes the irradiance of the step
  question.irradiance = ahead.irradiance();
}

std::vector<explore::Checked> check_points(const ExploreCommand& command, const explore::Question& question,
                                           const explore::Swept& swept,
                                           const std::vector<std::size_t>& points, const state::Volume& start,
                                           const step::Implementation& fast) {
  std::vector<explore::Checked> checked;
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  for (const std::size_t point : points) {
    if (!command.common.quiet) {
      const hwmodel::Configuration& hw = swept.points[point].hw;
      print_error("verifying {} of {}: {} lanes, {} steps\n", checked.size() + 1, points.size(), hw.lanes,
                  hw.cascade);
    }
    checked.push_back(
        check(question, swept, point, command.check_steps, {start, fast, tuning, stop_if_interrupted}));
  }
  return checked;
}

// Measures the software, and compares its bits with those of the best design, if that was simulated.
explore::SoftwareRun software_beside(const ExploreCommand& command, const explore::Explored& explored,
                                     const state::Volume& start, const step::Implementation& fast) {
  const std::optional<std::size_t> best = explored.answer.best;
  const explore::Checked* checked = best ? checked_at(explored, *best) : nullptr;
  if (checked != nullptr && !checked->good) checked = nullptr;
  step::Tuning tuning;
  tuning.threads = thread_count(command.common);
  return run_software(explored.question, {start, fast, tuning, stop_if_interrupted}, checked);
}

int run_explore(ExploreCommand command) {
  split_sets(command);
  const Common& common = command.common;
  explore::Question question;
  question.device = explore::load_device(command.device, command.device_sets);
  question.memory = find_memory(command.memory);
  question.steps = command.steps;
  scene::Scene scene = load_scene(common);
  refuse_changes(scene, "explore");
  keep_inputs(scene, {{"--report", common.report}, {"--out", command.out}});
  check_report_place(common, command.out);
  std::optional<io::OutputFolder> out;
  if (!command.out.empty()) out.emplace(command.out);
  end_soon_at_interrupts();
  question.parameters = scene.parameters;
  const std::string name = scene.name;
  const step::Implementation& fast = find_implementation(common);
  run::Simulation ahead = run_ahead(scene, common, command.from, command.steps);
  question.grid = ahead.volume().grid;
  require_stages_and_room(question, command.memory);
  question.first_step = ahead.step_number();
  const state::Volume start = ahead.volume();
  ask_of_first_step(question, start, ahead);

  explore::Axes axes = usual_axes(question);
  keep_only(axes, command.hw_sets);
  const explore::Swept swept = sweep(question, axes, SweepProgress(common.quiet));
  if (swept.points.empty())
    throw UsageError(
        fmt::format("error: hw.tile = {}: no lanes and steps that are tried can have such tiles: "
                    "a multiple of the lanes, and wider than two halos",
                    axes.tile.value_or(0)));
  const explore::Answer answer = answer_of(question, axes, swept);
  const explore::Ranges ranges = ranges_of(question, axes, swept, answer.best, SweepProgress(true));
  const std::vector<explore::Checked> checked =
      check_points(command, question, swept, chosen_points(answer, command.points), start, fast);
  explore::Explored explored{question, axes, swept, answer, ranges, checked, name, command.memory};
  explored.software = software_beside(command, explored, start, fast);
  print("{}", common.quiet ? sentence_of(explored) + "\n" : text_of(explored));
  const std::string json = json_of(explored);
  write_report(common, json);
  if (out) {
    io::write_file(out->partial() / "explore.json", json);
    io::write_file(out->partial() / "explore.csv", csv_of(explored));
    io::write_file(out->partial() / "explore.svg", svg_of(explored));
    out->commit();
    if (!common.quiet) print("picture, table and report  {}/\n", seen_from_here(out->place()));
  }
  const bool good =
      std::all_of(checked.begin(), checked.end(), [](const auto& one) { return one.verified(); });
  return good && explored.software->equal ? kDone : kCheckFailed;
}

}  // namespace

void add_explore(CommandLine& program) {
  auto options = std::make_shared<ExploreCommand>();
  const Command command = program.add("explore", std::string(description_of("explore")));
  add_scene(command, options->common);
  command.option("--device", options->device, "a device by name (zu7ev, ecp5-85f), or a TOML file")
      .required();
  command
      .option("--memory", options->memory,
              "a memory by name (`voxmelt list memories`), a TOML file, or none: it always answers")
      .shows_default();
  command.option("--steps", options->steps, "steps of the run whose time is predicted")
      .within(1u, 1000000u)
      .shows_default();
  command
      .option("--from", options->from,
              "steps that the software runs first (mid-melt): what lies in memory then is counted")
      .shows_default();
  command.option("--points", options->points, "designs of the front that are simulated and verified")
      .within(0u, 1000u)
      .shows_default();
  command
      .option("--check-steps", options->check_steps,
              "steps for which they are (default: one pass of the design)")
      .within(1u, 10000u);
  command.option("--out", options->out,
                 "folder for explore.svg, explore.csv (every design) and explore.json");
  add_common(command, options->common);
  add_visibility(command, options->common);
  std::string axes;
  for (const hwmodel::HwKey& key : hwmodel::kHwKeys)
    if (key.chosen()) axes += fmt::format("hw.{}, ", key.name);
  command.footer(
      fmt::format("--set also takes the device's numbers (device.bram=300, device.clock=250), and keeps one "
                  "value of an\naxis: {}hw.clock_mhz.",
                  axes));
  command.runs([options] { return run_explore(*options); });
}

}  // namespace voxmelt::app
