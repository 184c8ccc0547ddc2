// The command `voxmelt accuracy` tells how well the automaton does physics, against answers that mathematics
// gives.
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "accuracy/case.h"
#include "app/accuracy_front.h"
#include "app/commands.h"
#include "app/interrupt.h"
#include "app/message.h"
#include "app/options.h"
#include "app/print.h"
#include "app/programs.h"
#include "app/version.h"
#include "kernel/run/io/output_folder.h"
#include "report/accuracy/report.h"

namespace voxmelt::app {
namespace {

namespace fs = std::filesystem;
using accuracy::Case;

struct AccuracyOptions {
  Common common;
  std::vector<std::string> cases;
  std::vector<std::string> front;  // scenes of --front
  bool wants_front = false;
  std::string out;
  bool quick = false;
};

fs::path scenes_of_cases() {
  for (const fs::path& folder : scene_folders())
    if (fs::is_directory(folder / "accuracy")) return folder / "accuracy";
  throw UsageError("error: the scenes of the cases, scenes/accuracy, are not there");
}

std::vector<const Case*> chosen_cases(const std::vector<std::string>& names) {
  std::vector<const Case*> chosen;
  for (const Case& one : accuracy::all_cases())
    if (names.empty() || std::find(names.begin(), names.end(), one.name) != names.end())
      chosen.push_back(&one);
  for (const std::string& name : names)
    if (std::none_of(chosen.begin(), chosen.end(), [&](const Case* one) { return one->name == name; }))
      throw UsageError(
          fmt::format("--case {}: error: unknown; `voxmelt list cases` names those that there are", name));
  return chosen;
}

void print_header() {
  print("{:<42} {:>10} {:>10} {:>9} {:>9} {:<7} {:>7} {:>9}\n", "", "value", "exact", "error", "gate", "",
        "Mcell/s", "baseline");
}

void print_rows(const accuracy::Found& found) {
  print("{}: {}\n", found.one->name, found.one->title);
  for (const accuracy::Row& row : found.outcome.rows) {
    const auto& baseline = row.speed.baseline_cells_per_second;
    print("  {:<40} {:>10} {:>10} {:>9} {:>9} {:<7} {:>7} {:>9}  {}\n", row.setting,
          accuracy::number_text(row.value), accuracy::number_text(row.exact), accuracy::error_text(row),
          accuracy::gate_text(row),
          !row.gate      ? ""
          : row.passed() ? "passed"
                         : "MISSED",
          row.speed.cells_per_second > 0 ? accuracy::speed_text(row.speed.cells_per_second) : "-",
          baseline ? accuracy::speed_text(*baseline) : "-",
          row.quantity + (row.note.empty() ? "" : " (" + row.note + ")"));
  }
  std::fflush(stdout);
}

int run_accuracy(const AccuracyOptions& options) {
  const Common& common = options.common;
  accuracy::Conditions conditions;
  conditions.implementation = &find_implementation(common);
  conditions.threads = thread_count(common);
  conditions.quick = options.quick;
  conditions.sets = common.sets;
  if (common.seed) conditions.sets.push_back(fmt::format("run.seed={}", *common.seed));
  conditions.scenes = scenes_of_cases();
  if (options.wants_front) {
    if (!options.cases.empty()) throw UsageError("error: --front and --case exclude each other");
    conditions.scenes = conditions.scenes.parent_path();
    return run_front(common, {options.front, options.out, options.quick}, conditions);
  }
  const std::vector<const Case*> cases = chosen_cases(options.cases);
  check_report_place(common, options.out);
  end_soon_at_interrupts();
  std::optional<io::OutputFolder> out;
  if (!options.out.empty()) out.emplace(options.out);

  accuracy::Report report{.version = "voxmelt " + version_number(),
                          .implementation = conditions.implementation->name,
                          .threads = conditions.threads,
                          .quick = options.quick,
                          .sets = conditions.sets,
                          .found = {}};
  for (const Case* one : cases) {
    const auto start = std::chrono::steady_clock::now();
    accuracy::Found found{one, one->measure(conditions), 0};
    found.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (report.found.empty()) print_header();  // an error of the first case comes before any output
    print_rows(found);
    report.found.push_back(std::move(found));
    stop_if_interrupted();
  }
  print("{} of {} gates passed\n", report.gates() - report.missed(), report.gates());

  const std::string json = accuracy::json_text(report);
  write_report(common, json);
  if (out) {
    io::write_file(out->partial() / "accuracy.json", json);
    io::write_file(out->partial() / "accuracy.csv", accuracy::csv_text(report));
    io::write_file(out->partial() / "accuracy.md", accuracy::markdown_text(report));
    io::write_file(out->partial() / "accuracy.html", accuracy::html_text(report));
    out->commit();
    if (!common.quiet) print("page, tables and report  {}/\n", seen_from_here(out->place()));
  }
  return report.passed() ? kDone : kCheckFailed;
}

}  // namespace

void add_accuracy(CommandLine& program) {
  auto options = std::make_shared<AccuracyOptions>();
  const Command command = program.add("accuracy", std::string(description_of("accuracy")));
  command.flag("--quick", options->quick,
               "shorter cases, a minute of processor time (--front: one scene on a small grid, few points)");
  command.option("--case", options->cases, "this case only (repeatable); `voxmelt list cases` names them")
      .written_as("NAME")
      .one_each_time();
  const Option front =
      command
          .option("--front", options->front,
                  "instead: the time and the error of settings, of all scenes of the front or of these; one "
                  "thread, most of an hour")
          .written_as("[SCENE ...]")
          .any_number();
  command.option("--out", options->out,
                 "folder for accuracy.html, .md, .csv and .json (--front: front.html, ...)");
  add_common(command, options->common);
  command.footer(
      "Each case runs scenes, most of them from scenes/accuracy, and compares with what mathematics says,\n"
      "with the reference, or with finer grids. --set and --seed change every scene. A row without a gate\n"
      "is reported only. Ends with 1 where an error is larger than its gate. Baseline: the paper's program,\n"
      "plainly written, on the same start; for a scene of the viscous law it runs the paper's law.");
  command.runs([options, front] {
    options->wants_front = front.given();
    std::erase(options->front, "");  // --front alone gives an empty name
    return run_accuracy(*options);
  });
}

}  // namespace voxmelt::app
