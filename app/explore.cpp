// The command `voxmelt explore` finds the best hardware for a scene, on a device and a memory.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/commands.h"
#include "app/explore_command.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/programs.h"
#include "app/visibility.h"
#include "hwmodel/explore/explore_report.h"
#include "kernel/run/io/output_folder.h"

namespace voxmelt::app {
namespace {

namespace explore = hwmodel::explore;

// Splits the values of --set, which reaches the device, the axes of the sweep, and the scene.
void split_sets(ExploreCommand& command) {
  std::vector<std::string> scene;
  for (std::string& set : command.common.sets) {
    const bool of_device = set.starts_with("device.") || set.starts_with("family.");
    auto& one = set.starts_with("memory.") ? command.memory_sets
                : of_device                ? command.device_sets
                : set.starts_with("hw.")   ? command.hw_sets
                                           : scene;
    one.push_back(std::move(set));
  }
  command.common.sets = std::move(scene);
}

// Chooses the best design, and others of the front at equal distances, the slowest among them. The most
// frugal one takes the place of one between.
std::vector<std::size_t> chosen_points(const explore::Answer& answer, std::size_t wanted) {
  std::vector<std::size_t> chosen;
  const std::size_t n = answer.front.size(), count = std::min(wanted, n);
  for (std::size_t i = 0; i < count; ++i)
    chosen.push_back(answer.front[count == 1 ? 0 : i * (n - 1) / (count - 1)]);
  if (count > 2 && std::find(chosen.begin(), chosen.end(), *answer.frugal) == chosen.end())
    chosen[count / 2] = *answer.frugal;
  return chosen;
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

std::vector<explore::Checked> check_points(const ExploreCommand& command, const ExploreScene& scene,
                                           const explore::Swept& swept,
                                           const std::vector<std::size_t>& points) {
  std::vector<explore::Checked> checked;
  for (const std::size_t point : points) {
    if (!command.common.quiet) {
      const hwmodel::Configuration& hw = swept.points[point].hw;
      print_error("verifying {} of {}: {} lanes, {} steps\n", checked.size() + 1, points.size(), hw.lanes,
                  hw.cascade);
    }
    checked.push_back(check(scene.question(), swept, point, command.check_steps, scene.input()));
  }
  return checked;
}

// Measures the software, and compares its bits with those of the best design, if that was simulated.
explore::SoftwareRun software_beside(const explore::Explored& explored, const ExploreScene& scene) {
  const std::optional<std::size_t> best = explored.answer.best;
  const explore::Checked* checked = best ? checked_at(explored, *best) : nullptr;
  if (checked != nullptr && !checked->good) checked = nullptr;
  return run_software(explored.question, scene.input(), checked);
}

void write_files(const explore::Explored& explored, const std::string& json, io::OutputFolder& out) {
  io::write_file(out.partial() / "explore.json", json);
  io::write_file(out.partial() / "explore.csv", csv_of(explored));
  io::write_file(out.partial() / "explore.svg", svg_of(explored));
  out.commit();
}

int explore_one(const ExploreCommand& command) {
  const Common& common = command.common;
  ExploreScene scene(command, command.scenes.front());
  check_report_place(common, command.out);
  end_soon_at_interrupts();
  std::optional<io::OutputFolder> out;
  if (!command.out.empty()) out.emplace(command.out);
  scene.begin();
  const explore::Question& question = scene.question();
  const explore::Axes axes = asked_axes(usual_axes(question), question, command);
  const explore::Swept swept = sweep(question, axes, SweepProgress(common.quiet));
  if (swept.points.empty() && !axes.tile)
    throw UsageError(
        fmt::format("error: device.chain = {}: the grid is too narrow for so many tiles, each wider than two "
                    "halos",
                    question.device.chain));
  if (swept.points.empty())
    throw UsageError(
        fmt::format("error: hw.tile = {}: no lanes and steps that are tried can have such tiles: "
                    "a multiple of the lanes, and wider than two halos",
                    axes.tile.value_or(0)));
  const explore::Answer answer = answer_of(question, axes, swept);
  const explore::Ranges ranges = ranges_of(question, axes, swept, answer.best, stop_if_interrupted);
  const std::vector<explore::Checked> checked =
      check_points(command, scene, swept, chosen_points(answer, command.points));
  explore::Explored explored{question, axes, swept, answer, ranges, checked, scene.name(), command.memory};
  explored.software = software_beside(explored, scene);
  print("{}", common.quiet ? sentence_of(explored) + "\n" : text_of(explored));
  const std::string json = json_of(explored);
  write_report(common, json);
  if (out) {
    write_files(explored, json, *out);
    if (!common.quiet) print("picture, table and report  {}/\n", seen_from_here(out->place()));
  }
  const bool good =
      std::all_of(checked.begin(), checked.end(), [](const auto& one) { return one.verified(); });
  return good && explored.software->equal ? kDone : kCheckFailed;
}

int run_explore(ExploreCommand command) {
  if (!command.compared.empty()) {
    if (command.compared.size() != 2 || !command.scenes.empty())
      throw UsageError("error: --compare needs two reports of `voxmelt explore`, and no scene");
    return explore_compare(command);
  }
  for (const auto& [name, missing] :
       {std::pair("scene", command.scenes.empty()), std::pair("--device", command.device.empty())})
    if (missing) throw UsageError(fmt::format("error: {} is required; --help says more", name));
  split_sets(command);
  if (command.scenes.size() == 1)
    return command.swept.empty() ? explore_one(command) : explore_sweep(command);
  if (!command.swept.empty()) throw UsageError("error: --sweep takes one scene");
  return explore_batch(command);
}

}  // namespace

void add_explore(CommandLine& program) {
  auto options = std::make_shared<ExploreCommand>();
  const Command command = program.add("explore", std::string(description_of("explore")));
  command
      .option("scene", options->scenes,
              "scene file (TOML), a name of `voxmelt list scenes`, or a checkpoint; of several, one design "
              "for all")
      .any_number();
  command.option("--device", options->device, "a name of `voxmelt list devices`, or a TOML file");
  command
      .option("--memory", options->memory,
              "a memory by name (`voxmelt list memories`), a file, or none: it always answers")
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
  command.flag("--rtl", options->rtl, "only designs that `voxmelt rtl` writes");
  command.option("--out", options->out,
                 "folder for explore.svg, explore.csv (every design) and explore.json");
  command
      .option("--sweep", options->swept,
              "how the answer follows a number: memory.channels=1..32 doubles it, device.fill=0.5..0.9+0.1 "
              "adds, device.clock=150,200 lists")
      .written_as("KEY=VALUES");
  command
      .option("--for", options->aim,
              "what one design for several scenes is best in: the sum of times, or the worst share")
      .one_of({"sum", "worst"})
      .shows_default();
  command.option("--compare", options->compared, "what differs between two reports (explore.json)");
  add_common(command, options->common);
  add_visibility(command, options->common);
  std::string axes;
  for (const hwmodel::HwKey& key : hwmodel::kHwKeys)
    if (key.chosen()) axes += fmt::format("hw.{}, ", key.name);
  command.footer(fmt::format(
      "--set also takes numbers of the device (device.bram=300), its family (family.base.lut=9000) and the\n"
      "memory (memory.channels=4), and keeps one value of an axis: {}hw.clock_mhz.",
      axes));
  command.runs([options] { return run_explore(*options); });
}

}  // namespace voxmelt::app
